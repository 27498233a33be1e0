#!/bin/sh
# libraries.sh [suitesparse] [sundials]
#
# Print the compiler and linker flags of the libraries that the core needs, of both without argument. Exit 1, naming on stderr
# those that are nowhere, when one is missing.
# The only list of places to look: the Python build, the stand-alone Makefile and the set-up all ask here.
# SUITESPARSE_ROOT=/prefix and SUNDIALS_ROOT=/prefix override; CONDA_PREFIX counts only for the conda environment that is active.
# .libraries is what tools/setup_system.sh has unpacked.

# The first number that a header defines for a name.
number() { sed -n "s/^[[:space:]]*#[[:space:]]*define[[:space:]]\{1,\}$2[[:space:]]\{1,\}\([0-9]\{1,\}\).*/\1/p" "$1" | head -n 1; }

# Flags of a prefix, its directory of headers and its libraries.
flags() {
    prefix=$1 include=$2 line=""
    shift 2
    [ "$include" = /usr/include ] || line="-I$include"
    if [ "$prefix" != /usr ]; then
        for lib in "$prefix/lib" "$prefix/lib64"; do
            [ -d "$lib" ] && line="$line -L$lib -Wl,-rpath,$lib"
        done
    fi
    echo "$line $*"
}

# Is there klu.h below the prefix?
suitesparse_in() {
    for include in "$1/include/suitesparse" "$1/include"; do
        [ -f "$include/klu.h" ] || continue
        flags "$1" "$include" -lklu -lamd -lcolamd -lbtf -lsuitesparseconfig
        return 0
    done
    return 1
}

# Is there ARKODE of SUNDIALS >= 6.4 below the prefix? From 7 on what its parts share is a library of its own.
sundials_in() {
    config="$1/include/sundials/sundials_config.h" core=""
    [ -f "$config" ] && [ -f "$1/include/arkode/arkode_arkstep.h" ] || return 1
    major=$(number "$config" SUNDIALS_VERSION_MAJOR) minor=$(number "$config" SUNDIALS_VERSION_MINOR)
    [ -n "$major" ] && [ $((100 * major + ${minor:-0})) -ge 604 ] || return 1
    [ "$major" -lt 7 ] || core=-lsundials_core
    flags "$1" "$1/include" -lsundials_arkode -lsundials_nvecserial $core
}

# look name keg root: flags of a library in the first prefix that has it; keg is its directory in Homebrew.
look() {
    for place in "$3" "$CONDA_PREFIX" /usr /usr/local "/opt/homebrew/opt/$2" "/usr/local/opt/$2" /opt/homebrew /opt/local "$unpacked"; do
        [ -n "$place" ] && "$1_in" "$place" && return 0
    done
    return 1
}

unpacked="$(cd "$(dirname "$0")/.." && pwd)/.libraries"
found="" missing=0
for name in ${*:-suitesparse sundials}; do
    case "$name" in
        suitesparse) line=$(look suitesparse suite-sparse "$SUITESPARSE_ROOT") || { echo "SuiteSparse (klu.h)" >&2; missing=1; } ;;
        sundials) line=$(look sundials sundials "$SUNDIALS_ROOT") || { echo "SUNDIALS >= 6.4 (arkode)" >&2; missing=1; } ;;
        *) echo "libraries.sh: what is $name?" >&2; exit 2 ;;
    esac
    found="$found $line"
done
[ $missing = 0 ] && echo $found -lm

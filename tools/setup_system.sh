#!/usr/bin/env bash
# Make sure that what pip cannot install is there: a C compiler, SuiteSparse and SUNDIALS with headers, Python >= 3.11
# with headers and venv; for the tests also the sanitizers' libraries and, if they can be had, valgrind, chromium, Pango,
# BLAS and Tcl.
#
#   setup_system.sh run | test | memcheck
#
# Prints the Python interpreter to use on stdout, all else on stderr. What counts is that a small program compiles and
# links, not that a package has a certain name, so nothing is installed where everything is there already. Missing
# packages are installed by apt when we are root or sudo asks no password; otherwise one message names them and the exit
# code is 1.
#
# libsundials-dev and libsuitesparse-dev bring PETSc, MPI, a Fortran compiler, BLAS. Of what they name, apt installs the
# few libraries that the core links; headers go from the packages into .libraries, where core_c/libraries.sh finds them.
# Environment: PYTHON (interpreter to try first), CC, SUITESPARSE_ROOT, SUNDIALS_ROOT, EDESIGN_NO_INSTALL=1 (never call
# apt).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mode="${1:-run}"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

say() { echo "edesign: $*" >&2; }

# Path of an interpreter, if it is Python >= 3.11; the second argument asks for headers and venv as well.
check_python() {
    local full="${2:-}"
    "$1" -c "
import os, sys, sysconfig
fits = sys.version_info >= (3, 11)
if fits and '$full':
    import ensurepip, venv
    fits = os.path.exists(os.path.join(sysconfig.get_path('include'), 'Python.h'))
print(sys.executable) if fits else sys.exit(1)" 2>/dev/null
}

find_python() {
    local candidate
    for candidate in ${PYTHON:+"$PYTHON"} python3.11 python3 python3.12 python3.13 python3.14 /usr/bin/python3; do
        command -v "$candidate" >/dev/null && check_python "$candidate" "${1:-}" && return 0
    done
    return 1
}

# What is missing, in words for people ($missing) and as packages of apt ($packages); $hard counts the indispensable.
missing=() packages=() hard=0
wish() { missing+=("$1"); packages+=("${@:2}"); }
lack() { wish "$@"; hard=$((hard + 1)); }

look() {
    missing=() packages=() hard=0
    local base name sanitizers="the libraries of the address and undefined-behaviour sanitizers"
    cc=""
    if python="$(find_python full)"; then
        cc="${CC:-$("$python" -c 'import sysconfig; print(sysconfig.get_config_var("CC") or "cc")')}"
    elif base="$(find_python)" && base="$(readlink -f "$base")" && [[ "$base" == /usr/bin/python3.* ]]; then
        name="${base#/usr/bin/}"
        lack "headers and venv of $name" "$name-dev" "$name-venv"
    else
        lack "Python >= 3.11 with headers and venv" python3.11-or-later
    fi
    cc="${cc:-cc}"

    echo '#include <stdio.h>
int main(void) { return puts("") < 0; }' >"$scratch/c.c"
    if ! $cc -o "$scratch/c" "$scratch/c.c" -lm >/dev/null 2>&1; then
        lack "a C compiler" gcc libc6-dev
    elif [[ "$mode" == test ]]; then
        $cc -fsanitize=address,undefined -o "$scratch/c" "$scratch/c.c" >/dev/null 2>&1 || lack "$sanitizers" gcc
    fi

    sh core_c/libraries.sh suitesparse >/dev/null 2>&1 || lack "SuiteSparse (KLU) with headers" libsuitesparse-dev
    sh core_c/libraries.sh sundials >/dev/null 2>&1 || lack "SUNDIALS >= 6.4 (ARKODE) with headers" libsundials-dev
    if [[ $hard == 0 ]]; then
        cat >"$scratch/libraries.c" <<'END'
#include <Python.h>
#include <klu.h>
#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>
#ifndef SUNDIALS_DOUBLE_PRECISION
#error "SUNDIALS is not built for double precision"
#endif
#if SUNDIALS_VERSION_MAJOR < 7
#define SUN_COMM_NULL NULL
#endif
int main(void)
{
  klu_common common;
  SUNContext context;
  if (!klu_defaults(&common) || SUNContext_Create(SUN_COMM_NULL, &context))
    return 1;
  N_Vector y = N_VNew_Serial(1, context);
  void *solver = ARKStepCreate(NULL, NULL, 0.0, y, context); /* refuses to have no equations */
  N_VDestroy(y);
  return solver || SUNContext_Free(&context);
}
END
        # shellcheck disable=SC2046
        $cc -I"$("$python" -c 'import sysconfig; print(sysconfig.get_path("include"))')" \
            -o "$scratch/libraries" "$scratch/libraries.c" $(sh core_c/libraries.sh) >"$scratch/log" 2>&1 ||
            lack "a working set of C compiler, Python headers, SuiteSparse and SUNDIALS" \
                gcc libc6-dev libsuitesparse-dev libsundials-dev
    fi
    [[ "$mode" != run && "$(uname)" == Linux ]] || return 0
    if [[ "$mode" == memcheck ]]; then
        command -v valgrind >/dev/null || lack "valgrind" valgrind
        return 0
    fi
    command -v valgrind >/dev/null || wish "valgrind" valgrind
    has_browser || wish "chromium" chromium
    # what weasyprint lays text out with; libharfbuzz-subset0 is younger than some systems, and only makes it faster
    opens libpango-1.0.so.0 libpangoft2-1.0.so.0 || wish "Pango" libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0
    # what the LAPACK of OpenSeesPy asks for; scripts of `edesign translate` run by it as users run them
    opens libblas.so.3 || wish "BLAS" libblas3
    # in which its scripts in Tcl run; interpreters that are not the system's have their own, or none
    [[ -n "$python" && "$(readlink -f "$python")" != /usr/bin/* ]] || "${python:-false}" -c 'import tkinter' 2>/dev/null ||
        wish "the Tcl of Python" python3-tk
}

# The chromium of Ubuntu is a stub of a snap, which cannot read the folders of tests; they look for others themselves.
has_browser() { command -v chromium || command -v google-chrome || grep -s '^ID=ubuntu' /etc/os-release; } >/dev/null

# Whether the loader finds shared libraries.
opens() {
    [[ -n "$python" ]] && "$python" -c 'import ctypes, sys
for name in sys.argv[1:]: ctypes.CDLL(name)' "$@" 2>/dev/null
}

# The libraries that a development package names and the core links.
linked_of() {
    local pattern='libsundials-(arkode|nvecserial|core)[0-9]+'
    [[ "$1" == libsundials-dev ]] || pattern='lib(klu|amd|colamd|btf|suitesparseconfig)[0-9]+'
    apt-cache depends "$1" | grep -oxE "  Depends: $pattern(t64)?" | sed 's/.*: //'
}

# Headers of a development package, and links to the libraries of it that are installed, into .libraries.
unpack_headers() {
    local library file
    mkdir -p "$scratch/$1" .libraries/include .libraries/lib
    (cd "$scratch/$1" && apt-get -q download "$1" && dpkg-deb -x ./*.deb .) >>"$scratch/apt.log" 2>&1 || return 1
    cp -R "$scratch/$1/usr/include/." .libraries/include
    for library in $(linked_of "$1"); do
        for file in $(dpkg -L "$library" | grep -E '/lib[^/]*\.so\.[0-9]+$'); do
            ln -sf "$file" ".libraries/lib/$(basename "${file%.so.*}").so"
        done
    done
}

# What apt would download for some packages, with what they depend on.
download_size() {
    apt-get --print-uris -q -y install --no-install-recommends "$@" 2>/dev/null |
        awk '$3 ~ /^[0-9]+$/ { bytes += $3 } END { printf "%.1f MB", bytes / 1e6 }'
}

# apt_install few | whole: with the libraries of development packages that the core links, or with all they ask for.
apt_install() {
    local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300) version names=() name
    local unpacked=() linked
    [[ "$(id -u)" == 0 ]] || apt=(sudo -n "${apt[@]}")
    tools/step.sh "updating the package list (apt)" "${apt[@]}" update || true
    for name in "${packages[@]}"; do
        if [[ "$name" == python3.11-or-later ]]; then
            for version in 3.11 3.12 3.13 3.14 ""; do
                [[ -z "$version" ]] || apt-cache show "python$version-dev" >/dev/null 2>&1 && break
            done
            [[ -n "$version" ]] || { say "apt offers no Python >= 3.11 on this system"; return 1; }
            names+=("python$version" "python$version-dev" "python$version-venv")
        elif [[ "$1" == few && "$name" == libsu*-dev ]] && linked="$(linked_of "$name")"; then
            # shellcheck disable=SC2206
            names+=($linked)
            unpacked+=("$name")
        elif [[ "$name" == libharfbuzz-subset0 ]] && ! apt-cache show "$name" >/dev/null 2>&1; then
            continue
        else
            names+=("$name")
        fi
    done
    say "packages of the system: ${names[*]}"
    local what
    what="installing packages of the system (apt), $(download_size "${names[@]}") to download"
    if ! tools/step.sh "$what" "${apt[@]}" install --no-install-recommends "${names[@]}"; then
        # not every system with apt has chromium
        mapfile -t names < <(printf '%s\n' "${names[@]}" | grep -v '^chromium$')
        if [[ ${#names[@]} == 0 ]] ||
            ! tools/step.sh "$what" "${apt[@]}" install --no-install-recommends "${names[@]}"; then
            return 1
        fi
    fi
    for name in ${unpacked[@]+"${unpacked[@]}"}; do
        unpack_headers "$name" || return 1
    done
}

explain() {
    local apt="${packages[*]}" test_dnf="" test_conda=""
    apt="${apt/python3.11-or-later/python3.11 python3.11-dev python3.11-venv}"
    if [[ "$mode" != run ]]; then
        test_dnf=" libasan libubsan valgrind blas"
        test_conda=" valgrind"
    fi
    local words
    words="$(printf ', %s' "${missing[@]}")"
    echo "
edesign needs system packages that are missing here: ${words#, }.
Please install them once, then call make again (this is done for you only with apt, as root or by a sudo without password):

  Debian, Ubuntu   sudo apt-get install $apt
  Fedora, RHEL     sudo dnf install gcc glibc-devel suitesparse-devel sundials-devel python3-devel$test_dnf
  macOS            xcode-select --install; brew install suite-sparse sundials python@3.12
  conda            conda install -c conda-forge c-compiler suitesparse sundials 'python>=3.11'$test_conda

Another place for them: PYTHON=/path/to/python3, CC=compiler, SUITESPARSE_ROOT=/prefix, SUNDIALS_ROOT=/prefix.
" >&2
    [[ ! -s "$scratch/log" ]] || { echo "The compiler said:"; tail -n 5 "$scratch/log"; } >&2
}

look
if [[ ${#missing[@]} -gt 0 ]]; then
    may_install=no
    if [[ -z "${EDESIGN_NO_INSTALL:-}" ]] && command -v apt-get >/dev/null; then
        if [[ "$(id -u)" == 0 ]] || sudo -n true 2>/dev/null; then may_install=yes; fi
    fi
    if [[ $may_install == yes ]]; then
        for extent in few whole; do
            [[ $hard == 0 && $extent == whole ]] && break
            if apt_install "$extent"; then hash -r; look; fi
        done
    fi
fi
if [[ $hard -gt 0 ]]; then
    explain
    exit 1
fi
for name in ${missing[@]+"${missing[@]}"}; do
    say "$name is not here and cannot be installed; what needs it is skipped, or 'make memcheck' stops"
done
echo "$python"

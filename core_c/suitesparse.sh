#!/bin/sh
# Print the compiler flags that find SuiteSparse (klu.h and its libraries); exit 1 when it is nowhere.
# The only list of places to look: the Python build, the stand-alone Makefile and the set-up all ask here.
# SUITESPARSE_ROOT=/prefix overrides; CONDA_PREFIX counts only for the conda environment that is active.

for prefix in "$SUITESPARSE_ROOT" "$CONDA_PREFIX" /usr /usr/local /opt/homebrew/opt/suite-sparse \
              /usr/local/opt/suite-sparse /opt/homebrew /opt/local; do
    [ -n "$prefix" ] || continue
    for include in "$prefix/include/suitesparse" "$prefix/include"; do
        [ -f "$include/klu.h" ] || continue
        case "$prefix" in
            /usr) echo "-I$include" ;;
            *) echo "-I$include -L$prefix/lib -Wl,-rpath,$prefix/lib" ;;
        esac
        exit 0
    done
done
exit 1

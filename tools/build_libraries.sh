#!/bin/sh
# Build the libraries that the core needs from their sources, as shared libraries, for wheels that run on old systems.
#
#   build_libraries.sh PREFIX
#
# Afterwards SUITESPARSE_ROOT=PREFIX SUNDIALS_ROOT=PREFIX builds edesign with them. Of SuiteSparse only KLU is built, with
# AMD, COLAMD and BTF; of SUNDIALS only ARKODE with serial vectors. So neither BLAS nor Fortran nor MPI is needed.
# Needs git, a C compiler and cmake >= 3.22 (pip install cmake). Environment: SUITESPARSE_SOURCE and SUNDIALS_SOURCE,
# folders with the sources, which are then not fetched and whose version is not checked; CC, CFLAGS, MACOSX_DEPLOYMENT_TARGET as cmake knows them.
set -eu

[ $# = 1 ] || { echo "usage: build_libraries.sh PREFIX" >&2; exit 2; }
mkdir -p "$1"
prefix="$(cd "$1" && pwd)"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

# What was released under a tag is identified by its commit: a tag can be moved, a commit cannot.
suitesparse_git=https://github.com/DrTimothyAldenDavis/SuiteSparse.git
suitesparse_tag=v7.8.3 suitesparse_commit=d3c4926d2c47fd6ae558e898bfc072ade210a2a1
sundials_git=https://github.com/LLNL/sundials.git
sundials_tag=v7.5.0 sundials_commit=c8dabcea90ca8bf195474da120e4f3dd39aa711f

# sources folder given repository tag commit
sources() {
    if [ -n "$2" ]; then
        cp -R "$2" "$1"
        return
    fi
    git clone -q --depth 1 --branch "$4" -c advice.detachedHead=false "$3" "$1"
    got="$(git -C "$1" rev-parse HEAD)"
    [ "$got" = "$5" ] || { echo "build_libraries.sh: $4 of $3 is commit $got, not $5" >&2; exit 1; }
}

# where libraries look for each other: beside themselves
origin='$ORIGIN'
[ "$(uname)" != Darwin ] || origin=@loader_path

# build folder options ...
build() {
    folder="$1"
    shift
    # no paths of the sources in the libraries; libdir as core_c/libraries.sh looks for it
    cmake -S "$folder" -B "$folder/out" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
        -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_NAME_DIR="$prefix/lib" \
        -DCMAKE_INSTALL_RPATH="$origin" -DCMAKE_INSTALL_RPATH_USE_LINK_PATH=OFF \
        -DBUILD_SHARED_LIBS=ON -DBUILD_STATIC_LIBS=OFF "-DCMAKE_C_FLAGS=${CFLAGS:-} -ffile-prefix-map=$scratch=." \
        "$@" >"$folder.log" 2>&1 &&
        cmake --build "$folder/out" --parallel 2 >>"$folder.log" 2>&1 &&
        cmake --install "$folder/out" >>"$folder.log" 2>&1 || { tail -n 30 "$folder.log" >&2; exit 1; }
}

sources "$scratch/suitesparse" "${SUITESPARSE_SOURCE:-}" "$suitesparse_git" "$suitesparse_tag" "$suitesparse_commit"
# its configuration insists on a BLAS, of which these parts call nothing: libm stands for it
build "$scratch/suitesparse" -DBLAS_LIBRARIES=m "-DSUITESPARSE_ENABLE_PROJECTS=suitesparse_config;amd;colamd;btf;klu" \
    -DKLU_USE_CHOLMOD=OFF -DSUITESPARSE_USE_FORTRAN=OFF -DSUITESPARSE_USE_OPENMP=OFF -DSUITESPARSE_USE_CUDA=OFF \
    -DSUITESPARSE_CONFIG_USE_OPENMP=OFF -DSUITESPARSE_DEMOS=OFF -DBUILD_TESTING=OFF
sources "$scratch/sundials" "${SUNDIALS_SOURCE:-}" "$sundials_git" "$sundials_tag" "$sundials_commit"
build "$scratch/sundials" -DSUNDIALS_ENABLE_ERROR_CHECKS=ON -DBUILD_ARKODE=ON -DBUILD_CVODE=OFF -DBUILD_CVODES=OFF \
    -DBUILD_IDA=OFF -DBUILD_IDAS=OFF -DBUILD_KINSOL=OFF -DENABLE_MPI=OFF -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_INSTALL=OFF
ls "$prefix/lib"

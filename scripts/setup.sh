# What the two commands share: packages, a Python that can draw, configure and build.
# To be sourced, not run; it moves to the root of the tree, where all paths below start.
# shellcheck shell=bash

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
build=build/release

required_packages=(g++ cmake ninja-build libeigen3-dev libvtk9-dev libdeflate-dev libyaml-cpp-dev libmuparser-dev libspectra-dev
                   libcli11-dev libgtest-dev nlohmann-json3-dev python3-numpy python3-matplotlib python3-yaml python3-markdown)
optional_packages=(xvfb xauth)   # a screen for the 3-D picture; all else is drawn without one

say() { printf '%s\n' "-- $*"; }
fail() { printf '%s\n' "$*" >&2; exit 1; }

is_installed() {
  [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

# missing_of PACKAGE... : prints those that are not installed, one per line.
missing_of() {
  local package
  for package in "$@"; do
    is_installed "$package" && continue
    # ParaView's development files bring a VTK of their own, which CMake finds as well.
    [[ $package == libvtk9-dev ]] && is_installed paraview-dev && continue
    printf '%s\n' "$package"
  done
}

# may_install : sets `as_root`, the words in front of apt-get; false if there is no way to become root.
may_install() {
  as_root=()
  (( EUID == 0 )) && return 0
  command -v sudo >/dev/null || return 1
  as_root=(sudo)
  # Without a terminal sudo cannot ask for a password, so it must not need one.
  [[ -t 0 ]] || sudo -n true 2>/dev/null
}

apt() {
  # A fresh machine may be installing its own updates: wait for the lock instead of failing.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@"
}

# install PACKAGE... : keeps what apt-get says in a file and shows its end only if it fails.
install() {
  local log=build/packages.log
  mkdir -p build
  say "installing $* (details in $log; several minutes if VTK is among them)"
  # A list that cannot be refreshed may still be good enough, so only the installation decides.
  apt update >"$log" 2>&1 || say "the package lists could not be refreshed, trying those at hand"
  if ! apt install -y --no-install-recommends "$@" >>"$log" 2>&1; then
    tail -n 15 "$log" >&2
    return 1
  fi
}

# Installs what is missing and nothing else; apt-get is not called if nothing is missing.
need_packages() {
  local missing optional line
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "this is no Debian or Ubuntu; what is needed are their packages, or the like of them:"
    say "  ${required_packages[*]}"
  else
    mapfile -t missing < <(missing_of "${required_packages[@]}")
    mapfile -t optional < <(missing_of "${optional_packages[@]}")
    (( ${#missing[@]} + ${#optional[@]} )) || return 0
    if may_install; then
      if (( ${#missing[@]} )); then
        install "${missing[@]}" || fail "The packages could not be installed: ${missing[*]}"
      fi
      if (( ${#optional[@]} )); then
        install "${optional[@]}" || say "going on without ${optional[*]}: no 3-D picture"
      fi
    elif (( ${#missing[@]} )); then
      line="apt-get update && apt-get install -y --no-install-recommends ${missing[*]} ${optional[*]}"
      say "packages are missing and this user may not install them; an administrator would run:"
      say "  ${line% }"
    else
      say "going on without ${optional[*]}: no 3-D picture"
    fi
  fi
  # Without the packages the programs may still be there, by other ways; CMake judges the libraries.
  command -v cmake >/dev/null || fail "cmake is not installed, see the packages above."
  command -v "${CXX:-c++}" >/dev/null || command -v g++ >/dev/null ||
    fail "No C++ compiler is installed, see the packages above."
}

# Sets PYTHON to the first interpreter that can draw. The `python3` of the path is asked last: it may
# belong to a version manager and see none of the packages installed above.
find_python() {
  local candidate
  for candidate in "${NEREID_PYTHON:-}" "${VIRTUAL_ENV:+$VIRTUAL_ENV/bin/python3}" \
                   /usr/bin/python3 python3; do
    [[ -n $candidate ]] || continue
    if "$candidate" -c 'import numpy, matplotlib, yaml' 2>/dev/null; then
      PYTHON=$candidate
      return 0
    fi
    [[ $candidate != "${NEREID_PYTHON:-}" ]] ||
      say "NEREID_PYTHON=$candidate cannot import numpy, matplotlib and yaml; looking further"
  done
  fail "No Python imports numpy, matplotlib and yaml; name one by NEREID_PYTHON=<path>."
}

cores() { nproc 2>/dev/null || getconf _NPROCESSORS_ONLN; }

# Prints how many compilers may run at once: one per core, but each with 2 GiB, which the templates
# of the packs and of VTK take.
jobs_for_build() {
  local jobs kib limit by_memory
  jobs=$(cores)
  kib=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo 2>/dev/null) || kib=""
  if [[ -n $kib ]]; then
    # A container may be allowed less than the machine has.
    limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null) || limit=max
    [[ $limit == max ]] || (( limit / 1024 >= kib )) || kib=$(( limit / 1024 ))
    by_memory=$(( kib / (2 * 1024 * 1024) ))
    (( by_memory >= 1 )) || by_memory=1
    (( by_memory >= jobs )) || jobs=$by_memory
  fi
  printf '%s\n' "$jobs"
}

# configure_and_build [-DOPTION=VALUE]... TARGET... : in build/release; needs PYTHON for the tests.
configure_and_build() {
  local options=() targets=() argument
  for argument in "$@"; do
    if [[ $argument == -D* ]]; then options+=("$argument"); else targets+=("$argument"); fi
  done
  # A build folder keeps the generator it was made with; CMake refuses another.
  if [[ ! -f $build/CMakeCache.txt ]] && command -v ninja >/dev/null; then
    options+=(-G Ninja)
  fi
  say "configuring $build"
  cmake -S . -B "$build" --log-level=WARNING --no-warn-unused-cli -DCMAKE_BUILD_TYPE=Release -DNEREID_JOIN=ON -DNEREID_WERROR=ON \
        -DPython3_EXECUTABLE="$(command -v "$PYTHON")" "${options[@]}" >/dev/null
  say "building ${targets[*]}"
  cmake --build "$build" --parallel "$(jobs_for_build)" --target "${targets[@]}"
}

# What ./run and ./test share: packages and quiet builds. Sourced by bash; expects `top`, the project's folder.
# All messages go to standard error, so that standard output belongs to the program (`./run render ... -o -`).

say() { printf '%s\n' "$*" >&2; }
fail() { say "$@"; exit 1; }

# Names in sections of .packages.
packages_of() {
    local section
    for section in "$@"; do
        sed -n "/^\[$section\]/,/^\[/{/^[a-z0-9]/p}" "$top/.packages"
    done
}

# Installs what is missing of these sections; does nothing, fast, when nothing is.
need_packages() {
    command -v dpkg-query >/dev/null || return 0 # not Debian: the build names what it misses
    local wanted missing as_root=()
    mapfile -t wanted < <(packages_of "$@" | sort)
    mapfile -t missing < <(comm -23 <(printf '%s\n' "${wanted[@]}") \
        <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
            sed -n 's/^installed //p' | sort -u))
    ((${#missing[@]})) || return 0
    if ((EUID != 0)); then
        command -v sudo >/dev/null ||
            fail "Packages are missing and there is no sudo; as root run: apt-get install ${missing[*]}"
        as_root=(sudo)
    fi
    say "Installing ${#missing[@]} packages: ${missing[*]}"
    mkdir -p "$top/build"
    local log=$top/build/packages.log
    if ! { "${as_root[@]}" apt-get update &&
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
            "${missing[@]}"; } >"$log" 2>&1; then
        tail -n 15 "$log" >&2
        fail "Installing packages failed; all of the output is in $log"
    fi
}

# quiet_build PRESET TESTS [TARGET...]: configures if needed and builds. TESTS is 'tests' or 'no-tests'; a folder once
# configured with tests keeps them, so that ./run and ./test in turn rebuild nothing.
# Returns 1, after the end of the log, when the build fails.
quiet_build() {
    local preset=$1 tests=$2 dir=$top/build/$1
    shift 2
    local log=$dir/build.log target=()
    (($#)) && target=(--target "$@")
    mkdir -p "$dir"
    say "Building ($preset) ..."
    if ! {
        if [[ $tests == tests ]]; then
            grep -qs '^BRUMA_TESTS:BOOL=ON' "$dir/CMakeCache.txt" && [[ -f $dir/build.ninja ]] ||
                (cd "$top" && cmake --preset "$preset" -DBRUMA_TESTS=ON)
        else
            [[ -f $dir/build.ninja ]] || (cd "$top" && cmake --preset "$preset" -DBRUMA_TESTS=OFF)
        fi && cmake --build "$dir" "${target[@]}"
    } >"$log" 2>&1; then
        tail -n 30 "$log" >&2
        say "The build failed; all of its output is in $log"
        return 1
    fi
}

# Sourced by the tests of this folder: PROGRAM and SCRATCH are their arguments. A test ends by `finish`.
program=$1
scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch" || exit 1
faults=0

fault() {
    echo "FAULT: $*"
    faults=$((faults + 1))
}

# expect STATUS WORDS COMMAND...: runs the command, whose exit status and words on standard error are known.
expect() {
    local status=$1 words=$2 said
    shift 2
    said=$("$@" 2>&1 >"$scratch/standard-output")
    local got=$?
    [[ $got == "$status" ]] || fault "exit $got, not $status: $* says: $said"
    [[ $said == *"$words"* ]] || fault "'$words' is not said by: $* says: $said"
    [[ $said != *"fault of the program"* && $said != *"[json"* ]] || fault "$* says: $said"
}

# holds FILE WORDS: the file is as it was.
holds() {
    [[ $(cat -- "$1") == "$2" ]] || fault "$1 has changed"
}
is_png() {
    [[ $(head -c 4 -- "$1" | tail -c 3) == PNG ]] || fault "$1 is no PNG"
}

finish() {
    ((faults == 0)) || exit 1
    cd / && rm -rf "$scratch"
    echo "all as expected"
}

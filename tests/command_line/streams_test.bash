#!/usr/bin/env bash
# streams_test.bash PROGRAM SCRATCH: messages that nobody can take end no run; data that cannot be delivered are an error.
source "$(dirname "$0")/expect.bash" "$@"

# run STATUS REDIRECTION COMMAND...
run() {
    local status=$1 redirection=$2 got
    shift 2
    (exec >words 2>&1 && eval "exec $redirection" && exec "$@")
    got=$?
    [[ $got == "$status" ]] || fault "exit $got, not $status: $* $redirection"
}
render=("$program" render builtin:mesh-sphere --size 8x8)

for redirection in '2>/dev/full' '2>&-' '2> >(exec true)' '2>&- 1>&- 0<&-' '1>/dev/full' '1>&-'; do
    rm -f p.png
    run 0 "$redirection" "${render[@]}" -o p.png --stats p.json --repeats 1 --explain -v --auto-exposure
    is_png p.png
    [[ $(wc -c <p.png) -lt 2000 && $(head -c 1 p.json) == "{" ]] || fault "words are in a file with $redirection"
    run 0 "$redirection" "$program" reference builtin:sphere --size 2x2 -o r.exr --tolerance 0.1
    run 2 "$redirection" "$program" render missing.obj -o p.png
    run 2 "$redirection" "$program" render --nonsense
done

# Standard output that carries data and is full.
for words in "info builtin:sphere" parameters "compare p.png p.png" --help --version; do
    run 3 '1>/dev/full 2>said' "$program" $words
    [[ $(cat said) == *"standard output"* && $(wc -l <said) == 1 ]] || fault "$words says: $(cat said)"
    # Who closed it wanted nothing.
    run 0 '1>&-' "$program" $words
    run 0 '1> >(exec true)' "$program" $words
done
run 2 '1>/dev/full 2>said' "${render[@]}" -o -
[[ $(cat said) == *"standard output"* ]] || fault "a picture on a full standard output says: $(cat said)"
run 2 '1>&- 2>said' "${render[@]}" -o -
[[ $(cat said) == *"standard output"* ]] || fault "a picture on a closed standard output says: $(cat said)"
# Through a link of its own: a program that replaces links must not get hold of the machine's.
ln -s /proc/self/fd/1 stdout
run 2 '1>&-' "${render[@]}" -o p.png --stats stdout
[[ -L stdout ]] || fault "the link to standard output was replaced"
finish

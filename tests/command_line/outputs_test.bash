#!/usr/bin/env bash
# outputs_test.bash PROGRAM SCRATCH: nothing of the user's is lost, and output goes to what its name means.
source "$(dirname "$0")/expect.bash" "$@"

triangle=$'mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1'
printf '%s' "$triangle" >a.obj
printf 'newmtl red\nKd 1 0 0\nmap_Kd t.png\n' >a.mtl
draw() {
    "$program" render "$1" --size 8x8 "${@:2}"
}
expect 0 "" draw builtin:mesh-sphere -o t.png
cp t.png texture.kept

# Inputs by every door and every name, forced or not.
ln -s a.obj link.json
ln a.obj hard.json
for name in a.obj ./a.obj link.json hard.json a.mtl t.png; do
    # What is found out only by reading is refused for its kind before.
    expect 2 "name another file" draw a.obj -o p.png --stats $name
    expect 2 "name another file" draw a.obj -o p.png --graph $name
    expect 2 "files that were read" draw a.obj -o p.png --stats $name --force
    expect 2 "files that were read" draw a.obj -o p.png --graph $name --force
done
expect 2 "files that were read" draw a.obj -o t.png --force
expect 2 "files that were read" draw a.obj -o t.png --force --across "display.exposure=1 | display.exposure=2"
cp t.png f_0001.png
sed 's/t.png/f_0001.png/' a.mtl >b.mtl
sed 's/a.mtl/b.mtl/' a.obj >b.obj
expect 2 "files that were read" draw b.obj -o f.png --frames 0:2
[[ ! -e f_0000.png ]] || fault "pictures were drawn before one was refused"
[[ ! -e p.png ]] || fault "a picture was drawn before its statistics were refused"
expect 2 "files that were read" "$program" compare t.png texture.kept --heatmap t.png
expect 2 "files that were read" "$program" compare texture.kept t.png --heatmap ./t.png --force
holds a.obj "$triangle"
cmp -s t.png texture.kept || fault "the texture has changed"

# Files of another kind.
printf mine >notes.txt
cp notes.txt notes.png
cp notes.txt f2_0001.png
cp notes.txt h.hdr
for option in "-o notes.png" "-o x.png --stats notes.txt" "-o x.png --graph notes.txt" "-o f2.png --frames 0:1"; do
    expect 2 "--force" draw a.obj $option
done
expect 2 "--force" "$program" compare t.png t.png --heatmap notes.png
cp notes.txt r.exr
expect 2 "--force" "$program" reference builtin:sphere --size 2x2 -o r.exr
mkdir bench
cp notes.txt bench/frames.json
expect 2 "--force" "$program" bench frames builtin:sphere --size 8x8 --repeats 1 --warmup 0 -o bench
mkdir shaders
"$program" shaders --expand shaders >said || fault "shaders cannot be expanded"
expect 0 "" "$program" shaders --expand shaders
cp notes.txt shaders/composite_0.frag
expect 2 "--force" "$program" shaders --expand shaders
# The shaders that the program is made to read are inputs too.
expect 2 "files that were read" draw a.obj -o p.png --shaders shaders --stats shaders/composite_0.frag --force
for file in notes.txt notes.png f2_0001.png r.exr bench/frames.json shaders/composite_0.frag; do
    holds $file mine
done
expect 0 "" draw a.obj -o notes.png --force
is_png notes.png
expect 0 "" draw a.obj -o notes.png
expect 0 "" draw a.obj -o p.png --stats p.json --graph p.dot --repeats 1
expect 0 "" draw a.obj -o p.png --stats p.json --graph p.dot --repeats 1

# One file for two outputs.
expect 2 "of -o too" draw a.obj -o same.png --stats same.png
expect 2 "of --stats too" draw a.obj -o p.png --stats s.json --graph ./s.json

# What the name means.
mkdir far
ln -s far/real.png link.png
expect 0 "" draw a.obj -o link.png
[[ -L link.png ]] || fault "the link was replaced"
is_png far/real.png
chmod 640 far/real.png
expect 0 "" draw a.obj -o link.png
[[ $(stat -c %a far/real.png) == 640 ]] || fault "permissions were lost"
(umask 027 && draw a.obj -o masked.png)
[[ $(stat -c %a masked.png) == 640 ]] || fault "a new file does not follow the umask"
chmod 444 far/real.png
sum=$(cksum <far/real.png)
expect 2 "read-only" draw a.obj -o link.png --force
[[ $(cksum <far/real.png) == "$sum" ]] || fault "a read-only file was written"
ln -s round1 round2
ln -s round2 round1
expect 2 "circle" draw a.obj -o p.png --stats round1
# Who could replace the machine's own node works on a copy of it.
null=/dev/null
[[ -w /dev ]] && mknod null c 1 3 2>null.refused && null=$scratch/null
if [[ $null != /dev/null || ! -w /dev ]]; then
    expect 0 "" draw a.obj -o p.png --stats $null --graph $null --repeats 1
    [[ -c $null && ! -s $null ]] || fault "$null was replaced"
fi
# Through a link of its own, as above.
ln -s /proc/self/fd/1 stdout
expect 0 "" draw a.obj -o stdout
is_png standard-output
[[ -L stdout ]] || fault "the link to standard output was replaced"
mkfifo pipe.png
cat pipe.png >from-pipe &
expect 0 "" draw a.obj -o pipe.png
wait $!
[[ -p pipe.png ]] || fault "the pipe was replaced"
is_png from-pipe
{ echo head; draw a.obj -o p.png --graph stdout; echo foot; } >together
[[ $(head -n 1 together) == head && $(tail -n 1 together) == foot && $(wc -l <together) -gt 4 ]] ||
    fault "standard output was not appended to"

# Names as long as files are named, and names that are not UTF-8.
long=$(printf '%0251d' 0).png
expect 0 "" draw a.obj -o "$long"
is_png "$long"
expect 2 "shorter" draw a.obj -o "0$long"
expect 2 "shorter" draw a.obj -o "$long" --frames 0:1
odd=$'v\xff'
cp a.obj "$odd.obj"
expect 0 "" draw "$odd.obj" -o "$odd.png" --stats "$odd.json" --graph "$odd.dot" --repeats 1
is_png "$odd.png"
iconv -f UTF-8 -t UTF-8 "$odd.json" >/dev/null || fault "statistics are not UTF-8"
expect 0 "" "$program" info "$odd.obj"
expect 0 "" "$program" bench frames "$odd.obj" --size 8x8 --repeats 1 --warmup 0 -o far
iconv -f UTF-8 -t UTF-8 far/frames.json >/dev/null || fault "the bench's numbers are not UTF-8"

# Names of numbered pictures sort as their numbers do.
expect 0 "" draw builtin:mesh-sphere -o n.png --frames 9999:10000
[[ -e n_09999.png && -e n_10000.png ]] || fault "numbered pictures sort wrongly"

[[ -z $(find . -name '*.part') ]] || fault "temporary files are left"
finish

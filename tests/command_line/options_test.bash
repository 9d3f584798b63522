#!/usr/bin/env bash
# options_test.bash PROGRAM SCRATCH: an option that is taken does something; else it is refused.
source "$(dirname "$0")/expect.bash" "$@"

head -c 8 /dev/zero >v.raw
volume=(v.raw --dims 2x2x2 --type uint8)
render=("$program" render "${volume[@]}" --size 8x8 -o p.png)
expect 0 "" "${render[@]}"

for value in -1 -0.5 nan -nan; do
    expect 2 "--tolerance" "$program" compare p.png p.png --tolerance $value
done
expect 0 "" "$program" compare p.png p.png --tolerance 0
expect 0 "" "$program" compare p.png p.png
for value in nan inf -1 0; do
    expect 2 "--full-scale" "$program" compare p.png p.png --heatmap h.png --full-scale $value
done
expect 2 "--full-scale" "$program" compare p.png p.png --full-scale 0.5
for value in -1 -2 9223372036854775808; do
    expect 2 "--offset" "${render[@]}" --offset $value
    expect 2 "--offset" "$program" info "${volume[@]}" --offset $value
done
for value in 1e300 -1e300 inf nan 2e9; do
    expect 2 "--time" "${render[@]}" --time $value
done
expect 2 "nonsense" "$program" info v.raw --set nonsense=1
expect 2 "nonsense" "$program" info builtin:mesh-sphere --set nonsense=1
expect 2 "nonsense" "$program" info "${volume[@]}" --set nonsense=1
expect 2 "nonsense" "${render[@]}" --set nonsense=1
expect 0 "" "${render[@]}" --time 1e9 --offset 0
expect 0 "" "$program" info builtin:demo --set volume.density_scale=2

# What nothing looks at.
expect 2 "--dims" "$program" render builtin:sphere --dims 2x2x2 -o p.png
expect 2 "--type" "$program" info builtin:mesh-sphere --type uint8
expect 2 "--repeats" "${render[@]}" --repeats 3
expect 2 "--graph" "${render[@]}" --frames 0:1 --graph g.dot
expect 2 "--graph" "${render[@]}" --across 'display.exposure=1' --graph g.dot
expect 0 "--samples: plays no part" "${render[@]}" --samples 8
expect 0 "--scatterings: plays no part" "${render[@]}" --scatterings 1
expect 2 "'render'" "$program" --size 8x8 render builtin:sphere -o p.png
expect 2 "'render'" "$program" --set display.exposure=1 render builtin:sphere -o p.png
expect 2 "--shaders" "$program" info builtin:mesh-sphere --shaders nowhere
expect 2 "--set" "$program" bench volume --set volume.lighting=none -o bench
expect 0 "--photons: plays no part" "$program" reference builtin:sphere --size 2x2 -o r.exr --photons 2000
for option in --dims --type --spacing --offset --endian --camera --up; do
    expect 2 "$option" "${render[@]}" $option ''
done
for option in --stats --graph --frames --across --down; do
    expect 2 "$option" "${render[@]}" $option ''
done
expect 2 "--heatmap" "$program" compare p.png p.png --heatmap ''
expect 2 "standard output" "$program" compare p.png p.png --heatmap -
finish

#!/usr/bin/env bash
# Denoises the bundled renders by every filter there is.  Installs what it needs where it may, builds, writes pictures
# into out/ (before, after, reference, and the estimated error of each), and prints what the filters did to the error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

.ci/packages
echo "== configure"
cmake --preset release >/dev/null
echo "== build"
cmake --build --preset release --target denoise
denoise=build-release/examples/denoise
data=examples/data
mkdir -p out

# A bilateral filter of radius 0 changes nothing: it makes a picture of a file.
picture() { "$denoise" --filter bilateral --set radius=0 --outliers off "${@:2}" -o "out/$1.png" >/dev/null; }
# The number at a path of the JSON that denoise prints:  value metrics.input relmse
value() { tr -d ' \n{' <<<"$json" | sed "s/.*\"$1\":\([^}]*\).*/\1/; s/.*\"$2\":\([^,]*\).*/\1/"; }

filters=$("$denoise" --list | sed -n 's/^\([a-z_0-9]\+\) .*/\1/p')
echo "== denoise"
printf '\n%-8s %-18s %28s  %22s  %8s\n' render filter 'relative MSE' 'PSNR' seconds
for render in motion pan; do
    case $render in
        motion) inputs=("$data/motion_16spp_A.exr" "$data/motion_16spp_B.exr") ;;
        pan) inputs=("$data/pan_8spp.exr") ;;
    esac
    reference=$data/${render}_reference.exr
    picture "$render-before" "${inputs[@]}"
    picture "$render-reference" "$reference"
    for filter in $filters; do
        json=$("$denoise" --filter "$filter" "${inputs[@]}" -o "out/$render-$filter.png" \
            --error "out/$render-$filter-error.png" --reference "$reference" --json)
        printf '%-8s %-18s %12.5f -> %12.5f  %8.2f -> %8.2f dB  %6.2f\n' "$render" "$filter" \
            "$(value input relmse)" "$(value output relmse)" "$(value input psnr)" "$(value output psnr)" \
            "$(value seconds filter)"
    done
done
printf '\npictures: %s\n' "$PWD/out"

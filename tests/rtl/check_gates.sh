#!/usr/bin/env bash
# Counts the gates of some quick units again and compares the rows with rtl_ref/gates/gates.csv. Exit status 77: skipped,
# because Yosys is absent or not the version that the file names.
# usage: check_gates.sh ROOT
set -euo pipefail
gates=$1/rtl_ref/gates

if ! command -v yosys >/dev/null; then
    echo "skipped: Yosys is not installed"
    exit 77
fi
fresh=$("$gates/count_gates.sh" fp32_add fp32_compare near_to_far:Width=2 near_to_far:Width=3 stream_fifo:Width=7:Depth=8 \
    stream_fifo:Width=161:Depth=6 result_select free_slots:Slots=16 order_issue ray_step:Width=2:Row=17)
if [[ $(head -n1 <<<"$fresh") != $(head -n1 "$gates/gates.csv") ]]; then
    echo "skipped: gates.csv was made by another version: $(head -n1 "$gates/gates.csv")"
    exit 77
fi
while IFS= read -r row; do
    if ! grep -qxF -- "$row" "$gates/gates.csv"; then
        echo "expected a row of gates.csv, got $row"
        exit 1
    fi
done <<<"$fresh"
echo "$(($(wc -l <<<"$fresh") - 2)) units have the gates of gates.csv"

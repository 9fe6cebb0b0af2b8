#!/usr/bin/env bash
# Counts the gates of units of the RTL reference with Yosys, in NAND2 equivalents (nand2.lib), one CSV row each:
#
#   unit             module, and its parameters
#   gates            all of it
#   register_bits    flip-flops; register_gates: those of the gates that are theirs
#   multipliers      binary32 multipliers and adders in it (fp32_mul, fp32_add)
#   adders
#   depth            two-input gates and multiplexers between two registers, at most; mapped without restructuring
#
# Multipliers and adders are synthesised once and counted as often as they are used, and so are the parts of the pair
# tester, first pass and hit unit; the rest of a unit is flattened. Arrays of memory cells (slot_ram, storage, pair_ram)
# have no body here: no gates, and a path ends at them.
# usage: count_gates.sh UNIT...    UNIT is a module, or module:parameter=value:...; without any, all units of gates.csv
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

all_units=(fp32_mul fp32_add fp32_compare stream_fifo:Width=7:Depth=8 stream_fifo:Width=161:Depth=6
    stream_fifo:Width=64:Depth=16 near_to_far:Width=2 near_to_far:Width=3 near_to_far:Width=4 near_to_far:Width=6
    near_to_far:Width=8 slab_lane box_tester:Width=2 box_tester:Width=3 box_tester:Width=4 box_tester:Width=6
    box_tester:Width=8 pair_reject:Mode=0 pair_reject:Mode=1 pair_reject:Mode=2 exact_accumulator hit_unit
    pair_tester:Mode=0 pair_tester:Mode=1 pair_tester:Mode=2 result_select result_select:Passes=1
    mailbox:Entries=1 mailbox:Entries=2 mailbox:Entries=4 mailbox:Entries=8 mailbox:Entries=16
    held_stack:Width=4:Row=19 order_issue order_ram:Width=45:Slots=128 stack_ram:Slots=128:Row=19 free_slots:Slots=16
    free_slots:Slots=64 free_slots:Slots=128 multi_fifo:Width=7:Depth=8:Push=2:Pop=2
    multi_fifo:Width=46:Depth=4:Push=2:Pop=2
    multi_fifo:Width=267:Depth=8:Push=1:Pop=2 multi_fifo:Width=60:Depth=16:Push=3:Pop=2 stack_survivors:Row=11
    stack_survivors:Row=15 stack_survivors:Row=19 ray_step:Width=2:Row=17 ray_step:Width=4:Row=15
    ray_step:Width=4:Row=19 ray_step:Width=6:Row=21 ray_step:Width=8:Row=23 cache_control:Ways=4
    cache_control:Ways=16 cache_data)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A unit's modules are read as they are needed: what Yosys makes of one depends a little on everything that it has read.
mapfile -t packages < <(ls ./*/*_pkg.sv)
mapfile -t folders < <(printf -- '-libdir\n%s\n' ./*/)

# synthesise MODULE [PARAMETER=VALUE]...: leaves area.txt and depth.txt in the work folder.
synthesise() {
    local top=$1 setting settings=""
    for setting in "${@:2}"; do settings+="chparam -set ${setting/=/ } $top; "; done
    yosys -q -p "
        read_verilog -sv ${packages[*]} $(ls ./*/"$top.sv")
        $settings
        hierarchy -top $top ${folders[*]}
        rename -top unit
        setattr -mod -set keep_hierarchy 1 fp32_mul
        setattr -mod -set keep_hierarchy 1 fp32_add
        setattr -mod -set keep_hierarchy 1 *pair_reject*
        setattr -mod -set keep_hierarchy 1 *hit_unit*
        synth -flatten -top unit
        dfflegalize -cell \$_DFF_P_ x -cell \$_DFFE_PP_ x -cell \$_DFF_PN0_ x -cell \$_DFFE_PN0P_ x
        design -save generic
        techmap -map gates/flip_flops.v
        abc -liberty gates/nand2.lib
        opt_clean
        tee -q -o $work/area.txt stat -liberty gates/nand2.lib -top unit
        design -load generic
        abc -fast -g AND,NAND,OR,NOR,XOR,XNOR,MUX
        setattr -mod -unset keep_hierarchy *
        flatten
        delete t:storage t:slot_ram t:pair_ram
        tee -q -o $work/depth.txt ltp -noff" >"$work/log.txt" 2>&1 || {
        cat "$work/log.txt" >&2
        return 1
    }
}

# The last counts of a kind of cell are those of the whole design.
row() {
    awk -v unit="$1" '
        $1 ~ /^(DFF|DFFE|DFFR|DFFRE|fp32_mul|fp32_add)$/ && NF == 2 && $2 ~ /^[0-9]+$/ { count[$1] = $2 }
        /Chip area for (top )?module/ { gates = $NF }
        /Longest topological path/ { sub(/.*length=/, ""); depth = $0 + 0 }
        END {
            bits = count["DFF"] + count["DFFE"] + count["DFFR"] + count["DFFRE"]
            registers = 5.67 * count["DFF"] + 5.80 * count["DFFE"] + 6.67 * count["DFFR"] + 6.80 * count["DFFRE"]
            printf "%s,%.0f,%d,%.0f,%d,%d,%d\n", unit, gates, bits, registers, count["fp32_mul"], count["fp32_add"], depth
        }' "$work/area.txt" "$work/depth.txt"
}

(($# > 0)) || set -- "${all_units[@]}"
echo "# $(yosys -V | cut -d' ' -f1,2), gates/count_gates.sh"
echo "unit,gates,register_bits,register_gates,multipliers,adders,depth"
for unit in "$@"; do
    IFS=: read -ra words <<<"$unit"
    synthesise "${words[@]}"
    row "$unit"
done

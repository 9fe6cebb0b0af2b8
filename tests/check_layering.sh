#!/usr/bin/env bash
# Checks the arrows between the folders: model <- traces <- sim <- study <- apps, where an arrow means "may be included
# by" (the link graph alone does not: headers of every target are visible to every other). study may also run the
# reference in rtl_ref. Also that model knows nothing of SystemC and that only apps prints. Prints every breach as
# FILE:LINE: what; exit status 1 when there is one.
# usage: check_layering.sh ROOT
set -euo pipefail
cd "$1"

declare -A may_include=(
    [model]='model'
    [traces]='model|traces'
    [sim]='model|traces|sim'
    [study]='model|traces|sim|study|rtl_ref'
    [apps]='model|traces|sim|study|apps'
    [rtl_ref]='model|rtl_ref'
)
breaches=0

# breach FOLDER MESSAGE PATTERN [EXCEPTION]: reports the lines of the folder that match, comments left out.
breach() {
    local folder=$1 message=$2 pattern=$3 exception=${4:-'^$'} file line text
    while IFS=: read -r file line text; do
        text=${text%%//*}
        if [[ $text =~ $pattern && ! $text =~ $exception ]]; then
            echo "$file:$line: $message: $text"
            breaches=$((breaches + 1))
        fi
    done < <(grep -rnE --include='*.[ch]pp' -- "$pattern" "$folder" || true)
}

for folder in model traces sim study apps rtl_ref; do
    [[ -d $folder ]] || continue
    allowed=${may_include[$folder]}
    breach "$folder" "expected an include from ${allowed//|/, }" '^ *# *include *"' "^ *# *include *\"($allowed)/[a-z]"
    if [[ $folder != apps ]]; then
        breach "$folder" "only apps may print" \
            '(std::(cout|cerr|clog|print|puts)|fmt::print|(^|[^a-zA-Z_0-9])(printf|fprintf|puts|putchar)) *[(<;]'
    fi
done
breach model "model must not know SystemC" '# *include *<(systemc|tlm)'

if ((breaches > 0)); then
    echo "$breaches breaches of the layers"
    exit 1
fi
echo "layers hold"

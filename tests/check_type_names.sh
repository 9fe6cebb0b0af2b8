#!/usr/bin/env bash
# Checks that no two types of one namespace have the same name: the linker would merge their functions silently, and
# one of the two would run the other's code. Types in unnamed namespaces are free. Prints every type that is defined
# twice with its places; exit status 1 when there is one.
# usage: check_type_names.sh ROOT
set -euo pipefail
cd "$1"

folders=()
for folder in model traces sim study apps rtl_ref; do
    if [[ -d $folder ]]; then folders+=("$folder"); fi
done

# The layout is clang-format's: what a namespace holds is not indented, and its end says `// namespace`.
find "${folders[@]}" -name '*.[ch]pp' -print0 | sort -z | xargs -0 awk '
    FNR == 1 { depth = 0 }
    /^namespace[ {]/ { names[++depth] = $2; next }
    /^} *\/\/ namespace/ { depth--; next }
    /^(struct|class|union|enum) / && !/;$/ {
        line = $0
        sub(/^(struct|union|class|enum (class )?)/, "", line)
        sub(/alignas\([^)]*\)/, "", line)
        if (!match(line, /^ *[A-Za-z_0-9]+/)) next
        name = substr(line, RSTART, RLENGTH)
        gsub(/ /, "", name)
        if (substr(line, RSTART + RLENGTH) ~ /^(<|::)/) next  # a specialisation, or defined inside its own class
        place = ""
        for (i = 1; i <= depth; i++) {
            if (names[i] == "{") next
            place = place names[i] "::"
        }
        type = place name
        if (type in first) { print FILENAME ":" FNR ": " type " is also in " first[type]; found++ }
        else first[type] = FILENAME ":" FNR
    }
    END {
        if (found) exit 1
        print "every type has a name of its own"
    }' || exit 1

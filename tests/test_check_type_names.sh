#!/usr/bin/env bash
# Checks check_type_names.sh itself: it passes what is allowed and finds a type that is defined twice.
# usage: test_check_type_names.sh CHECK_SCRIPT
set -euo pipefail
check=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir "$tree"/{model,study}

# write FILE LINE...: the lines inside namespace rtu::study.
write() {
    local file=$1
    shift
    printf '%s\n' 'namespace rtu::study {' "$@" '}  // namespace rtu::study' >"$tree/$file"
}

write study/a.hpp 'struct Row {' '};' 'template <>' 'struct Of<int> {' '};' 'enum class Kind {' '};'
write study/b.hpp 'struct Row;' 'namespace {' 'struct Row {' '};' '}  // namespace' 'struct Table::Row {' '};' \
    'template <>' 'struct Of<double> {' '};'
printf '%s\n' 'namespace rtu::model {' 'struct Row {' '};' '}  // namespace rtu::model' >"$tree/model/a.hpp"
bash "$check" "$tree"

for line in 'struct Row {' 'class Row final {' 'enum class Kind {' 'enum Kind {' 'struct alignas(64) Row {'; do
    write study/c.hpp "$line" '};'
    if output=$(bash "$check" "$tree"); then
        echo "not found: $line" && exit 1
    fi
    if [[ $output != 'study/c.hpp:2: rtu::study::'*' is also in study/a.hpp:'* ]]; then
        echo "expected a breach at study/c.hpp:2 for: $line" && echo "got: $output" && exit 1
    fi
done
echo "every kind of double is found"

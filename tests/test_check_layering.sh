#!/usr/bin/env bash
# Checks check_layering.sh itself: it passes a clean tree and finds each kind of breach, at the right line.
# usage: test_check_layering.sh CHECK_SCRIPT
set -euo pipefail
check=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir "$tree"/{model,sim,study,apps}

# expect FILE CONTENT: a file with one more line must be a breach at that line, and only there.
expect() {
    local file=$1 content=$2 output
    printf '#pragma once\n%s\n' "$content" >"$tree/$file"
    if output=$(bash "$check" "$tree"); then
        echo "not found: $file: $content" && exit 1
    fi
    if [[ $output != "$file:2: "*$'\n''1 breaches of the layers' ]]; then
        echo "expected one breach at $file:2 for: $content"
        echo "got: $output"
        exit 1
    fi
    rm "$tree/$file"
}

printf '#include "model/a.hpp"\n#include <vector>\n// #include "sim/a.hpp"\n' >"$tree/model/a.cpp"
printf '#include "model/a.hpp"\n#include "sim/b.hpp"\n#include <systemc>\n' >"$tree/sim/b.cpp"
printf '#include "sim/b.hpp"\n#include "study/c.hpp"\nstd::snprintf(a, 1, b);\n' >"$tree/study/c.cpp"
printf '#include "study/c.hpp"\nstd::cout << 1;\n' >"$tree/apps/d.cpp"
bash "$check" "$tree"

expect model/x.cpp '#include "sim/b.hpp"'
expect model/x.hpp '  #  include "apps/d.hpp"'
expect model/x.hpp '#include "../sim/b.hpp"'
expect model/x.hpp '#include "a.hpp"'
expect model/x.hpp '#include <systemc>'
expect model/x.cpp '#include <tlm_utils/simple_target_socket.h>'
expect sim/x.cpp '#include "study/c.hpp"'
expect study/x.cpp '#include "apps/d.hpp"'
expect study/x.cpp '#include "tests/scenes.hpp"'
expect sim/x.cpp 'std::cout << 1;'
expect sim/x.cpp '    printf("1");'
expect study/x.cpp 'fmt::print("1");'
expect model/x.cpp 'std::fprintf(stderr, "1");'
echo "every kind of breach is found"

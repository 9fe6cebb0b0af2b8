#pragma once

#include <string>

#include "apps/run_plan.hpp"

// The commands of `rtusim trace`, once the command line is read. All return the exit code and throw Error.

namespace rtu::apps {

struct RecordArguments {
    RunArguments run;
    std::string scene;  ///< empty: the built-in one
    std::string output;
    bool has_visits = false;
};
int record_trace(const RecordArguments& arguments);

struct InspectArguments {
    std::string file;
    std::string recovered;  ///< empty: not asked for
};
int print_trace_info(const InspectArguments& arguments);
int verify_trace(const InspectArguments& arguments);

struct ConvertArguments {
    std::string input, output;
    std::string from, to;  ///< empty: by content or extension
    std::string kind = "closest";
    std::string name = "rays";  ///< of the workload, where the input names none
    std::string workload;       ///< empty: all
    std::string scene;          ///< empty: none
    bool is_builtin_scene = false;
};
int convert_rays(const ConvertArguments& arguments);

}  // namespace rtu::apps

#pragma once

#include <string>

#include "sim/effective_config.hpp"

namespace rtu::study {

/// A machine, and what it is called in tables.
struct NamedMachine {
    std::string name;
    sim::EffectiveConfig machine;
};

}  // namespace rtu::study

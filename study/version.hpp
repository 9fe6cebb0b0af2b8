#pragma once

#include <string_view>

namespace rtu::study {

/// rtusim's version, as reports name it.
[[nodiscard]] std::string_view version();

}  // namespace rtu::study

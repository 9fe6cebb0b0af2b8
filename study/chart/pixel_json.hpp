#pragma once

#include <string>
#include <string_view>

#include "study/chart/pixel_data.hpp"

namespace rtu::study {

/// The box tests of every pixel: {"scene", "width", "height", "box_tests": [width * height]}, row by row from
/// the top left; what `rtusim report` makes its heat map from.
[[nodiscard]] std::string box_tests_json(std::string_view scene, const PixelData& pixels);

}  // namespace rtu::study

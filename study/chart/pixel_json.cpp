#include "study/chart/pixel_json.hpp"

#include <nlohmann/json.hpp>

namespace rtu::study {

std::string box_tests_json(std::string_view scene, const PixelData& pixels) {
    using Json = nlohmann::ordered_json;
    const Json document{{"scene", scene},
                        {"width", pixels.resolution.width},
                        {"height", pixels.resolution.height},
                        {"box_tests", pixels.box_tests}};
    // A scene's name is a file's name, and that need not be UTF-8.
    return document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rtu::study

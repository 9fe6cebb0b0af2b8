#include "study/report/page_assets.hpp"

// Symbols of the object that cmake/EmbedFiles.cmake makes.
extern "C" {
extern const char rtu_page_frame[], rtu_page_frame_end[];
extern const char rtu_page_style[], rtu_page_style_end[];
extern const char rtu_page_script[], rtu_page_script_end[];
extern const char rtu_page_library[], rtu_page_library_end[];
extern const char rtu_page_licence[], rtu_page_licence_end[];
}

namespace rtu::study {
namespace {

std::string_view between(const char* begin, const char* end) { return {begin, std::size_t(end - begin)}; }

}  // namespace

PageAssets page_assets() {
    return {between(rtu_page_frame, rtu_page_frame_end), between(rtu_page_style, rtu_page_style_end),
            between(rtu_page_script, rtu_page_script_end), between(rtu_page_library, rtu_page_library_end),
            between(rtu_page_licence, rtu_page_licence_end)};
}

}  // namespace rtu::study

#include "study/chart/picture.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "model/error.hpp"

namespace rtu::study {
namespace {

using Pixel = Picture::Pixel;

constexpr Pixel background{32, 34, 38};
constexpr Pixel ink{225, 225, 225};

// Even steps of lightness along a path of hues from blue (306 degrees) over teal to yellow (103 degrees) in
// CIE L*C*h, with as much chroma as sRGB can show.
constexpr std::array<Pixel, 17> heat_colours{{{40, 25, 82},
                                              {38, 39, 96},
                                              {36, 53, 109},
                                              {33, 67, 122},
                                              {31, 80, 133},
                                              {31, 94, 143},
                                              {15, 109, 154},
                                              {5, 124, 157},
                                              {0, 139, 159},
                                              {0, 155, 159},
                                              {29, 170, 155},
                                              {58, 184, 147},
                                              {94, 198, 134},
                                              {132, 210, 118},
                                              {165, 221, 105},
                                              {202, 231, 92},
                                              {242, 238, 81}}};

// Digits 0 to 9, three columns and five rows each; row by row from the top, the leftmost column is bit 2.
constexpr std::array<std::array<std::uint8_t, 5>, 10> digit_rows{{{7, 5, 5, 5, 7},
                                                                  {2, 6, 2, 2, 7},
                                                                  {7, 1, 7, 4, 7},
                                                                  {7, 1, 7, 1, 7},
                                                                  {5, 5, 7, 1, 1},
                                                                  {7, 4, 7, 1, 7},
                                                                  {7, 4, 7, 5, 7},
                                                                  {7, 1, 1, 2, 2},
                                                                  {7, 5, 7, 5, 7},
                                                                  {7, 5, 7, 1, 7}}};
constexpr std::uint32_t digit_scale = 2;  // picture pixels a font pixel
constexpr std::uint32_t digit_height = 5 * digit_scale;
constexpr std::uint32_t digit_advance = 4 * digit_scale;

constexpr std::uint32_t scale_gap = 6, scale_width = 12;
constexpr std::uint32_t text_inset = 4;  // of the numbers from the upper and lower edge
constexpr std::uint32_t smallest_height = 64;

void draw_digit(Picture& picture, std::uint32_t left, std::uint32_t top, std::size_t digit) {
    for (std::uint32_t y = 0; y < 5 * digit_scale; ++y) {
        for (std::uint32_t x = 0; x < 3 * digit_scale; ++x) {
            const unsigned row = digit_rows[digit][y / digit_scale];
            if ((row >> (2 - x / digit_scale) & 1U) != 0) picture.at(left + x, top + y) = ink;
        }
    }
}

void draw_number(Picture& picture, std::uint32_t left, std::uint32_t top, std::string_view digits) {
    for (const char c : digits) {
        draw_digit(picture, left, top, std::size_t(c - '0'));
        left += digit_advance;
    }
}

// The colours from `largest` at the top down to 0, and the numbers beside them.
void draw_scale(Picture& picture, std::uint32_t left, std::uint32_t largest) {
    const std::uint32_t last = picture.height - 1;
    for (std::uint32_t y = 0; y <= last; ++y) {
        const Pixel colour = heat_colour(float(last - y) / float(last));
        for (std::uint32_t x = 0; x < scale_width; ++x) picture.at(left + x, y) = colour;
    }
    const std::uint32_t text_left = left + scale_width + scale_gap;
    draw_number(picture, text_left, text_inset, std::to_string(largest));
    draw_number(picture, text_left, (picture.height - digit_height) / 2, std::to_string(largest / 2));
    draw_number(picture, text_left, picture.height - digit_height - text_inset, "0");
}

}  // namespace

Pixel heat_colour(float value) {
    const float place = std::clamp(value, 0.0F, 1.0F) * float(heat_colours.size() - 1);
    const std::size_t index = std::min(std::size_t(place), heat_colours.size() - 2);
    const float part = place - float(index);
    Pixel result{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float low = heat_colours[index][i], high = heat_colours[index + 1][i];
        result[i] = std::uint8_t(std::lround(low + (high - low) * part));
    }
    return result;
}

Picture normal_picture(const PixelData& data) {
    Picture picture(data.resolution.width, data.resolution.height, background);
    for (std::size_t i = 0; i < data.normals.size(); ++i) {
        if (!data.normals[i]) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            picture.pixels[i][axis] = std::uint8_t(std::lround(((*data.normals[i])[axis] + 1) * 127.5F));
        }
    }
    return picture;
}

Picture heat_map(const PixelData& data) {
    const auto [width, height] = data.resolution;
    const std::uint32_t largest = *std::max_element(data.box_tests.begin(), data.box_tests.end());
    const auto digits = std::uint32_t(std::to_string(largest).size());
    const std::uint32_t margin = scale_gap + scale_width + scale_gap + digits * digit_advance + scale_gap;
    Picture picture(width + margin, std::max(height, smallest_height), background);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::uint32_t tests = data.box_tests[std::size_t{y} * width + x];
            picture.at(x, y) = heat_colour(largest == 0 ? 0.0F : float(tests) / float(largest));
        }
    }
    draw_scale(picture, width + scale_gap, largest);
    return picture;
}

std::string to_png(const Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = picture.width;
    image.height = picture.height;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    const auto encode = [&](void* memory) {
        const int is_done =
            png_image_write_to_memory(&image, memory, &size, 0, picture.pixels.data(), 0, nullptr);
        RTU_CHECK(is_done != 0, "libpng: {}", image.message);
    };
    encode(nullptr);  // only tells how many bytes it takes
    std::string bytes(size, '\0');
    encode(bytes.data());
    return bytes;
}

}  // namespace rtu::study

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "study/chart/pixel_data.hpp"

namespace rtu::study {

/// An sRGB picture, row by row from the top left.
struct Picture {
    using Pixel = std::array<std::uint8_t, 3>;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Pixel> pixels;  ///< [width * height]

    Picture(std::uint32_t w, std::uint32_t h, Pixel fill)
        : width(w), height(h), pixels(std::size_t{w} * h, fill) {}
    [[nodiscard]] Pixel& at(std::uint32_t x, std::uint32_t y) { return pixels[std::size_t{y} * width + x]; }
};

/// The hit surface: (normal + 1) / 2 as red, green and blue; a miss is dark grey.
[[nodiscard]] Picture normal_picture(const PixelData& data);

/// Box tests of each pixel's ray, from 0 to the largest of the picture, and at the right a scale with the
/// numbers at its ends and in the middle. At least 64 pixels high.
[[nodiscard]] Picture heat_map(const PixelData& data);

/// Colour of `value` in [0, 1] (clamped), from dark blue to bright yellow; lightness (CIE L*) rises evenly
/// from 14 to 92.
[[nodiscard]] Picture::Pixel heat_colour(float value);

/// The picture as a PNG file.
[[nodiscard]] std::string to_png(const Picture& picture);

}  // namespace rtu::study

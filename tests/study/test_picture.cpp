#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cmath>

#include "study/chart/picture.hpp"

namespace rtu::study {
namespace {

using Pixel = Picture::Pixel;

PixelData example_pixels(std::uint32_t width, std::uint32_t height) {
    PixelData data{{width, height}, {}, {}};
    for (std::uint32_t i = 0; i < width * height; ++i) {
        data.box_tests.push_back(i);
        data.normals.push_back(i == 0 ? std::nullopt : std::optional(model::Vec3{1, 0, -1}));
    }
    return data;
}

// CIE L* of an sRGB colour (IEC 61966-2-1), 0 to 100.
double lightness(Pixel colour) {
    const auto linear = [](std::uint8_t value) {
        const double c = value / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    const double y = 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
    return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(HeatMap, LightnessRisesEvenly) {
    for (int i = 0; i <= 100; ++i) {
        EXPECT_NEAR(lightness(heat_colour(float(i) / 100)), 14 + 78 * i / 100.0, 1.0) << i;
    }
}

TEST(HeatMap, ClampsBeyondItsEnds) {
    EXPECT_EQ(heat_colour(-1), heat_colour(0));
    EXPECT_EQ(heat_colour(2), heat_colour(1));
}

TEST(HeatMap, ScalesFromZeroToTheLargestCount) {
    const PixelData data = example_pixels(80, 70);
    Picture picture = heat_map(data);
    EXPECT_GT(picture.width, 80U);  // the scale stands beside
    EXPECT_EQ(picture.height, 70U);
    EXPECT_EQ(picture.at(0, 0), heat_colour(0));
    EXPECT_EQ(picture.at(79, 69), heat_colour(1));
    EXPECT_EQ(picture.at(10, 35), heat_colour(float(35 * 80 + 10) / float(80 * 70 - 1)));
    const std::uint32_t scale_x = 80 + 10;
    EXPECT_EQ(picture.at(scale_x, 0), heat_colour(1));
    EXPECT_EQ(picture.at(scale_x, 69), heat_colour(0));
}

TEST(HeatMap, OfATinyPictureOrWithoutTestsIsStillDrawn) {
    PixelData data = example_pixels(1, 1);
    EXPECT_EQ(heat_map(data).at(0, 0), heat_colour(0));
    EXPECT_GE(heat_map(data).height, 64U);
    data.box_tests = {4'294'967'295};
    EXPECT_EQ(heat_map(data).at(0, 0), heat_colour(1));
}

TEST(NormalPicture, ShowsNormalsAsColoursAndMissesAsBackground) {
    Picture picture = normal_picture(example_pixels(3, 2));
    ASSERT_EQ(picture.pixels.size(), 6U);
    EXPECT_EQ(picture.at(1, 1), (Pixel{255, 128, 0}));
    EXPECT_NE(picture.at(0, 0), picture.at(1, 1));
}

TEST(Png, DecodesToTheSamePixels) {
    Picture picture = heat_map(example_pixels(80, 70));
    const std::string bytes = to_png(picture);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
    image.format = PNG_FORMAT_RGB;
    ASSERT_EQ(image.width, picture.width);
    ASSERT_EQ(image.height, picture.height);
    std::vector<Pixel> decoded(picture.pixels.size());
    ASSERT_NE(png_image_finish_read(&image, nullptr, decoded.data(), 0, nullptr), 0) << image.message;
    EXPECT_EQ(decoded, picture.pixels);
    EXPECT_EQ(bytes, to_png(picture));
}

}  // namespace
}  // namespace rtu::study

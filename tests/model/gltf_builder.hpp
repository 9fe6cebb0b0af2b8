#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/vec3.hpp"

namespace rtu::test {

/// A folder of its own that disappears with the test.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(testing::TempDir()) /
                (std::string("rtusim_") + test->test_suite_name() + "_" + test->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

inline constexpr int component_uint8 = 5121;
inline constexpr int component_uint16 = 5123;
inline constexpr int component_uint32 = 5125;
inline constexpr int component_float = 5126;

/// Builds a glTF document with one buffer, member by member; tests then damage `document` or `bytes` as they
/// like.
struct GltfBuilder {
    nlohmann::json document = {{"asset", {{"version", "2.0"}}},
                               {"scene", 0},
                               {"scenes", {{{"nodes", {0}}}}},
                               {"nodes", {{{"mesh", 0}}}}};
    std::string bytes;

    /// Appends data as a bufferView; returns its index.
    template <class T>
    std::size_t add_view(std::span<const T> data, std::size_t stride_bytes = 0) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        nlohmann::json view = {
            {"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size_bytes()}};
        if (stride_bytes != 0) {
            view["byteStride"] = stride_bytes;
        }
        if (!data.empty()) {
            const std::size_t start = bytes.size();
            bytes.resize(start + data.size_bytes());
            std::memcpy(bytes.data() + start, data.data(), data.size_bytes());
        }
        document["bufferViews"].push_back(view);
        return document["bufferViews"].size() - 1;
    }
    std::size_t add_accessor(nlohmann::json accessor) {
        document["accessors"].push_back(std::move(accessor));
        return document["accessors"].size() - 1;
    }
    std::size_t add_positions(const std::vector<model::Vec3>& positions) {
        return add_accessor({{"bufferView", add_view(std::span(positions))},
                             {"componentType", component_float},
                             {"count", positions.size()},
                             {"type", "VEC3"}});
    }
    template <class T>
    std::size_t add_indices(const std::vector<T>& indices) {
        return add_accessor({{"bufferView", add_view(std::span(indices))},
                             {"componentType", sizeof(T) == 1   ? component_uint8
                                               : sizeof(T) == 2 ? component_uint16
                                                                : component_uint32},
                             {"count", indices.size()},
                             {"type", "SCALAR"}});
    }
    /// Adds a mesh of one primitive; returns its index.
    std::size_t add_mesh(nlohmann::json primitive) {
        document["meshes"].push_back({{"primitives", {std::move(primitive)}}});
        return document["meshes"].size() - 1;
    }
    /// The primitive of mesh 0.
    nlohmann::json& primitive() { return document["meshes"][0]["primitives"][0]; }

    /// The document with its buffer as a data URI.
    [[nodiscard]] std::string gltf() const {
        nlohmann::json full = document;
        if (!full.contains("buffers")) {
            full["buffers"] = {{{"byteLength", bytes.size()},
                                {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        }
        return full.dump();
    }
    /// The document and its buffer as GLB.
    [[nodiscard]] std::string glb() const {
        nlohmann::json full = document;
        if (!full.contains("buffers")) {
            full["buffers"] = {{{"byteLength", bytes.size()}}};
        }
        std::string json = full.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::string binary = bytes;
        binary.resize((binary.size() + 3) / 4 * 4);
        return "glTF" + uint32(2) + uint32(28 + json.size() + binary.size()) + uint32(json.size()) + "JSON" +
               json + uint32(binary.size()) + std::string("BIN\0", 4) + binary;
    }

    static std::string uint32(std::size_t value) {
        std::string text(4, '\0');
        for (std::size_t i = 0; i < 4; ++i) {
            text[i] = static_cast<char>(value >> (8 * i) & 0xffU);
        }
        return text;
    }
    static std::string base64(const std::string& data) {
        constexpr std::string_view digits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < data.size(); i += 3) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                bits = bits << 8U | (i + k < data.size() ? static_cast<unsigned char>(data[i + k]) : 0U);
            }
            for (std::size_t k = 0; k < 4; ++k) {
                text += i + k > data.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
            }
        }
        return text;
    }
};

/// The smallest useful file: one square of two indexed triangles, 16-bit indices.
inline GltfBuilder square() {
    GltfBuilder builder;
    const std::size_t positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const std::size_t indices = builder.add_indices(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3});
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    return builder;
}

}  // namespace rtu::test

#include "traces/npy_header.hpp"

#include <algorithm>
#include <charconv>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/regular_file.hpp"
#include "traces/bytes.hpp"

namespace rtu::traces {
namespace {

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t header_bytes = 128;
constexpr std::size_t longest_header = 1 << 16;

// Reads the literal of a Python dictionary with the three keys that NumPy writes.
class HeaderText {
  public:
    explicit HeaderText(std::string_view text) : text_(text) {}

    std::uint64_t ray_count() {
        expect('{');
        while (!accept('}')) {
            const std::string_view key = quoted();
            expect(':');
            if (key == "descr") {
                check_value("descr", "'<f4' (numpy.float32, little-endian)", "'<f4'");
            } else if (key == "fortran_order") {
                check_value("fortran_order", "False (C order)", "False");
            } else if (key == "shape") {
                read_shape();
            } else {
                throw Error("header: expected descr, fortran_order and shape, got '{}'", key);
            }
            if (!accept(',')) {
                expect('}');
                break;
            }
        }
        if (seen_ != 3) throw Error("header: expected descr, fortran_order and shape");
        skip_blanks();
        if (!text_.empty()) throw Error("header: expected nothing after '}}'");
        return rays_;
    }

  private:
    void skip_blanks() { text_.remove_prefix(std::min(text_.find_first_not_of(" \n"), text_.size())); }
    bool accept(char c) {
        skip_blanks();
        if (!text_.starts_with(c)) return false;
        text_.remove_prefix(1);
        return true;
    }
    void expect(char c) {
        if (!accept(c)) throw Error("header: expected '{}' at '{}'", c, model::one_line(text_));
    }
    std::string_view quoted() {
        expect('\'');
        const std::size_t end = text_.find('\'');
        if (end == std::string_view::npos) throw Error("header: a name without an end");
        const std::string_view word = text_.substr(0, end);
        text_.remove_prefix(end + 1);
        return word;
    }
    void check_value(std::string_view key, std::string_view expected, std::string_view value) {
        skip_blanks();
        if (!text_.starts_with(value)) {
            const std::string_view got = text_.substr(0, text_.find_first_of(",}"));
            throw Error("{}: expected {}, got {}; numpy: rays.astype('<f4', order='C')", key, expected,
                        model::one_line(got));
        }
        text_.remove_prefix(value.size());
        ++seen_;
    }
    void read_shape() {
        skip_blanks();
        const std::size_t end = text_.find(')');
        const std::string_view shape = text_.substr(0, end == std::string_view::npos ? end : end + 1);
        const char* last = shape.data() + shape.size();
        const auto fail = [&] {
            throw Error("shape: expected (ray_count, 8), got {}", model::one_line(shape));
        };
        if (!shape.starts_with('(')) fail();
        const auto [next, error] = std::from_chars(shape.data() + 1, last, rays_);
        if (error != std::errc{} || std::string_view(next, last) != ", 8)") fail();
        text_.remove_prefix(shape.size());
        ++seen_;
    }

    std::string_view text_;
    std::uint64_t rays_ = 0;
    int seen_ = 0;
};

}  // namespace

RawLayout read_npy_header(const std::filesystem::path& path) {
    model::RegularFile file(path);
    std::string bytes(std::min<std::uint64_t>(file.size_bytes(), longest_header), '\0');
    file.read(bytes.data(), bytes.size());
    try {
        ByteReader in(bytes);
        if (in.take(magic.size()) != magic) throw Error("byte 0: not an NPY file");
        const auto major = in.number<std::uint8_t>();
        const auto minor = in.number<std::uint8_t>();
        if (major < 1 || major > 3 || minor != 0) {
            throw Error("byte 6: expected NPY version 1.0, 2.0 or 3.0, got {}.{}", major, minor);
        }
        const std::uint64_t size = major == 1 ? in.number<std::uint16_t>() : in.number<std::uint32_t>();
        const std::uint64_t begin = magic.size() + 2 + (major == 1 ? 2 : 4) + size;
        return {8, begin, HeaderText(in.take(size)).ray_count()};
    } catch (const Error& error) {
        throw Error("{}: {}", path.string(), error.what());
    }
}

std::string npy_header(std::uint64_t ray_count) {
    const std::string text =
        fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, 8), }}", ray_count);
    ByteWriter out;
    out.padded(magic, magic.size());
    out.number(std::uint8_t{1});
    out.number(std::uint8_t{0});
    const std::size_t text_bytes = header_bytes - out.bytes().size() - 2;
    out.number(std::uint16_t(text_bytes));
    return out.bytes() + fmt::format("{:<{}}\n", text, text_bytes - 1);
}

}  // namespace rtu::traces

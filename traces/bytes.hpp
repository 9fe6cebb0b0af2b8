#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "model/error.hpp"

// Numbers as little-endian bytes, whatever the machine.

namespace rtu::traces {

/// Appends values to a string of bytes.
class ByteWriter {
  public:
    template <class Unsigned>
    void number(Unsigned value) {
        static_assert(std::is_unsigned_v<Unsigned>);
        for (std::size_t i = 0; i < sizeof value; ++i) bytes_.push_back(char(value >> (8 * i) & 0xffU));
    }
    void number(float value) { number(std::bit_cast<std::uint32_t>(value)); }
    /// `text` in `size` bytes, the rest zero. Requires text.size() <= size.
    void padded(std::string_view text, std::size_t size) {
        bytes_.append(text);
        bytes_.append(size - text.size(), '\0');
    }
    /// A u16 length and the text; what is longer than 1,024 bytes is cut.
    void text(std::string_view text) {
        text = text.substr(0, longest_text);
        number(std::uint16_t(text.size()));
        bytes_.append(text);
    }
    [[nodiscard]] std::string& bytes() { return bytes_; }

    static constexpr std::size_t longest_text = 1024;

  private:
    std::string bytes_;
};

/// Takes values from the front of some bytes; throws Error when there are too few.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    [[nodiscard]] std::string_view take(std::size_t size) {
        if (size > bytes_.size()) throw Error("expected {} more bytes, found {}", size, bytes_.size());
        const std::string_view part = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return part;
    }
    template <class Unsigned>
    [[nodiscard]] Unsigned number() {
        static_assert(std::is_unsigned_v<Unsigned>);
        const std::string_view part = take(sizeof(Unsigned));
        Unsigned value = 0;
        for (std::size_t i = 0; i < part.size(); ++i) {
            value = Unsigned(value | Unsigned(static_cast<unsigned char>(part[i])) << (8 * i));
        }
        return value;
    }
    [[nodiscard]] float real() { return std::bit_cast<float>(number<std::uint32_t>()); }
    /// As ByteWriter::padded() wrote it; throws Error when anything follows the first zero.
    [[nodiscard]] std::string padded(std::size_t size) {
        const std::string_view part = take(size);
        const std::string_view text = part.substr(0, part.find('\0'));
        if (part.find_first_not_of('\0', text.size()) != std::string_view::npos) {
            throw Error("expected zeros after the name '{}'", text);
        }
        return std::string(text);
    }
    [[nodiscard]] std::string text() {
        const auto size = number<std::uint16_t>();
        if (size > ByteWriter::longest_text) {
            throw Error("expected a text of at most {} bytes, got {}", ByteWriter::longest_text, size);
        }
        return std::string(take(size));
    }
    /// Reserved bytes; throws Error unless they are zero.
    void zeros(std::size_t size) {
        if (take(size).find_first_not_of('\0') != std::string_view::npos) {
            throw Error("expected reserved bytes to be zero");
        }
    }
    void end() const {
        if (!bytes_.empty()) throw Error("expected the end of the block, found {} more bytes", bytes_.size());
    }

  private:
    std::string_view bytes_;
};

}  // namespace rtu::traces

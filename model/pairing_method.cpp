#include <charconv>
#include <optional>

#include "model/error.hpp"
#include "model/pairing.hpp"

namespace rtu::model {
namespace {

constexpr std::string_view window_prefix = "window:";

std::optional<std::uint32_t> parse_window(std::string_view digits) {
    std::uint32_t window = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), window);
    const bool is_number = error == std::errc() && end == digits.data() + digits.size();
    return is_number && window >= 2 && window <= max_pairing_window ? std::optional(window) : std::nullopt;
}

}  // namespace

PairingMethod parse_pairing_method(std::string_view text) {
    if (text == "none") return {PairingKind::None, 0};
    if (text == "edge_bbsa") return {PairingKind::EdgeBbsa, 0};
    if (text.starts_with(window_prefix)) {
        const auto window = parse_window(text.substr(window_prefix.size()));
        if (window) return {PairingKind::Window, *window};
    }
    throw Error("pairing: expected none, window:N with N from 2 to {}, or edge_bbsa, got '{}'",
                max_pairing_window, text);
}

std::string to_string(PairingMethod method) {
    switch (method.kind) {
        case PairingKind::None:
            return "none";
        case PairingKind::Window:
            return fmt::format("{}{}", window_prefix, method.window);
        case PairingKind::EdgeBbsa:
            return "edge_bbsa";
    }
    fail_check(__FILE__, __LINE__, "unknown pairing kind");
}

EdgeIdentity parse_edge_identity(std::string_view text) {
    if (text == "position") return EdgeIdentity::Position;
    if (text == "index") return EdgeIdentity::Index;
    throw Error("edge identity: expected position or index, got '{}'", text);
}

std::string_view to_string(EdgeIdentity identity) {
    return identity == EdgeIdentity::Position ? "position" : "index";
}

}  // namespace rtu::model

#include <array>
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

struct NamedKind {
    std::string_view name;
    PairingKind kind;
};

constexpr std::array kinds{NamedKind{"none", PairingKind::None},
                           NamedKind{"edge_bbsa", PairingKind::EdgeBbsa},
                           NamedKind{"edge_bbsa_compressed", PairingKind::EdgeBbsaCompressed},
                           NamedKind{"sa_exchange", PairingKind::SaExchange},
                           NamedKind{"sa_saving", PairingKind::SaSaving},
                           NamedKind{"maximum", PairingKind::Maximum}};

}  // namespace

PairingMethod parse_pairing_method(std::string_view text) {
    for (const auto& [name, kind] : kinds) {
        if (text == name) return {kind, 0};
    }
    if (text.starts_with(window_prefix)) {
        const auto window = parse_window(text.substr(window_prefix.size()));
        if (window) return {PairingKind::Window, *window};
    }
    throw Error("pairing: expected {}, with N from 2 to {}, got '{}'", pairing_method_names,
                max_pairing_window, text);
}

std::string to_string(PairingMethod method) {
    if (method.kind == PairingKind::Window) return fmt::format("{}{}", window_prefix, method.window);
    for (const auto& [name, kind] : kinds) {
        if (method.kind == kind) return std::string(name);
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

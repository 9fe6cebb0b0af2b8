#include "model/gltf_json.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "model/error.hpp"
#include "model/one_line.hpp"

namespace rtu::model {

namespace {

using nlohmann::json;

constexpr int max_nesting = 64;
constexpr std::uint64_t index_end = std::uint64_t(1) << 31;
constexpr std::uint64_t size_end = std::uint64_t(1) << 32;

/// What a member of an object must be.
enum class Type : std::uint8_t { Index, Indices, IndexMap, Size, Text, Numbers, Object, Array };

struct Member {
    const char* key;
    Type type;
    bool is_required = false;
};

bool is_integer_below(const json& value, std::uint64_t end) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() < end;
}

bool is_index(const json& value) { return is_integer_below(value, index_end); }

bool has_type(const json& value, Type type) {
    switch (type) {
        case Type::Index:
            return is_index(value);
        case Type::Indices:
            return value.is_array() && std::ranges::all_of(value, is_index);
        case Type::IndexMap:
            return value.is_object() && std::ranges::all_of(value, is_index);
        case Type::Size:
            return is_integer_below(value, size_end);
        case Type::Text:
            return value.is_string();
        case Type::Numbers:
            return value.is_array() && std::ranges::all_of(value, &json::is_number);
        case Type::Object:
            return value.is_object();
        case Type::Array:
            return value.is_array();
    }
    return false;
}

std::string_view to_string(Type type) {
    switch (type) {
        case Type::Index:
            return "an integer from 0 to 2^31 - 1";
        case Type::Indices:
            return "an array of integers from 0 to 2^31 - 1";
        case Type::IndexMap:
            return "an object whose values are integers from 0 to 2^31 - 1";
        case Type::Size:
            return "an integer from 0 to 2^32 - 1";
        case Type::Text:
            return "a string";
        case Type::Numbers:
            return "an array of numbers";
        case Type::Object:
            return "an object";
        case Type::Array:
            return "an array";
    }
    return "";
}

/// Checks the members of `object`, which is `where` in the document (with the file's name before it).
void check_members(const json& object, const std::string& where, std::initializer_list<Member> members) {
    if (!object.is_object()) {
        throw Error("{}: expected an object, found {}", where, object.type_name());
    }
    for (const Member& member : members) {
        const auto found = object.find(member.key);
        if (found == object.end()) {
            if (member.is_required) {
                throw Error("{}: expected the member '{}', found none", where, member.key);
            }
        } else if (!has_type(*found, member.type)) {
            throw Error("{}.{}: expected {}, found {}", where, member.key, to_string(member.type),
                        found->is_structured() ? found->type_name() : one_line(found->dump()));
        }
    }
}

/// Calls check(element, its place) for every element of array `key`, where the document has one.
template <class Check>
void for_each_element(const json& object, const std::string& where, const char* key, Check check) {
    const auto found = object.find(key);
    if (found == object.end()) {
        return;
    }
    if (!found->is_array()) {
        throw Error("{}{}: expected an array, found {}", where, key, found->type_name());
    }
    for (std::size_t i = 0; i < found->size(); ++i) {
        check((*found)[i], fmt::format("{}{}[{}]", where, key, i));
    }
}

void check_accessor(const json& accessor, const std::string& where) {
    check_members(accessor, where,
                  {{"bufferView", Type::Index},
                   {"byteOffset", Type::Size},
                   {"componentType", Type::Index, true},
                   {"count", Type::Size, true},
                   {"type", Type::Text, true},
                   {"sparse", Type::Object}});
    if (!accessor.contains("sparse")) {
        return;
    }
    const json& sparse = accessor["sparse"];
    check_members(
        sparse, where + ".sparse",
        {{"count", Type::Index, true}, {"indices", Type::Object, true}, {"values", Type::Object, true}});
    check_members(sparse["indices"], where + ".sparse.indices",
                  {{"bufferView", Type::Index, true},
                   {"byteOffset", Type::Index},
                   {"componentType", Type::Index, true}});
    check_members(sparse["values"], where + ".sparse.values",
                  {{"bufferView", Type::Index, true}, {"byteOffset", Type::Index}});
}

void check_mesh(const json& mesh, const std::string& where) {
    check_members(mesh, where, {{"primitives", Type::Array, true}});
    for_each_element(mesh, where + ".", "primitives", [](const json& primitive, const std::string& place) {
        check_members(
            primitive, place,
            {{"attributes", Type::IndexMap, true}, {"indices", Type::Index}, {"mode", Type::Index}});
    });
}

void check_node(const json& node, const std::string& where) {
    check_members(node, where,
                  {{"mesh", Type::Index},
                   {"children", Type::Indices},
                   {"matrix", Type::Numbers},
                   {"rotation", Type::Numbers},
                   {"scale", Type::Numbers},
                   {"translation", Type::Numbers}});
    struct Length {
        const char* key;
        std::size_t length;
    };
    for (const auto& [key, length] :
         {Length{"matrix", 16}, Length{"rotation", 4}, Length{"scale", 3}, Length{"translation", 3}}) {
        if (node.contains(key) && node[key].size() != length) {
            throw Error("{}.{}: expected {} numbers, found {}", where, key, length, node[key].size());
        }
    }
}

/// True for extensions that change how a surface looks or is lit, but not where it is.
bool leaves_geometry_alone(std::string_view extension) {
    constexpr std::array<std::string_view, 5> prefixes{"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                       "MSFT_texture_", "KHR_lights_"};
    return std::ranges::any_of(prefixes,
                               [&](std::string_view prefix) { return extension.starts_with(prefix); });
}

void check_asset(const json& document, const std::string& name) {
    if (!document.is_object() || !document.contains("asset")) {
        throw Error("{}: not a glTF file: expected a JSON object with the member 'asset'", name);
    }
    check_members(document["asset"], name + ": asset",
                  {{"version", Type::Text, true}, {"minVersion", Type::Text}});
    const json& asset = document["asset"];
    const auto version = asset["version"].get<std::string>();
    if (!version.starts_with("2.")) {
        throw Error("{}: expected glTF version 2.x, found version {}", name, one_line(version));
    }
    if (const auto needed = asset.value("minVersion", "2.0"); needed != "2.0") {
        throw Error("{}: needs a reader of glTF {}, this one reads 2.0", name, one_line(needed));
    }
    for_each_element(
        document, name + ": ", "extensionsRequired", [&](const json& value, const std::string& where) {
            if (!value.is_string()) {
                throw Error("{}: expected a string, found {}", where, value.type_name());
            }
            if (const auto extension = value.get<std::string>(); !leaves_geometry_alone(extension)) {
                throw Error("{}: requires the extension {}, which is not supported", name,
                            one_line(extension));
            }
        });
}

/// The deepest nesting of brackets outside strings. Counted ahead, because destroying and printing a document
/// recurse.
int nesting_depth(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool is_in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            is_in_string = !is_in_string;
        } else if (is_in_string) {
            i += c == '\\' ? 1 : 0;  // the next character is no quote, or an escaped one
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return deepest;
}

json parse(const std::string& text, const std::string& name) {
    if (const int depth = nesting_depth(text); depth > max_nesting) {
        throw Error("{}: expected JSON of at most {} levels, found {}", name, max_nesting, depth);
    }
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        std::string_view reason = error.what();
        reason.remove_prefix(
            std::min(reason.size(), reason.find("] ") + 2));  // the library's own error number
        throw Error("{}: the JSON is broken: {}", name, one_line(reason));
    }
}

}  // namespace

json parse_gltf_json(const std::string& text, const std::string& name) {
    json document = parse(text, name);
    check_asset(document, name);
    const std::string where = name + ": ";
    check_members(document, where + "document", {{"scene", Type::Index}});
    for_each_element(document, where, "buffers", [](const json& buffer, const std::string& place) {
        check_members(buffer, place, {{"byteLength", Type::Size, true}, {"uri", Type::Text}});
    });
    for_each_element(document, where, "bufferViews", [](const json& view, const std::string& place) {
        check_members(view, place,
                      {{"buffer", Type::Index, true},
                       {"byteOffset", Type::Size},
                       {"byteLength", Type::Size, true},
                       {"byteStride", Type::Size}});
    });
    for_each_element(document, where, "accessors", check_accessor);
    for_each_element(document, where, "meshes", check_mesh);
    for_each_element(document, where, "nodes", check_node);
    for_each_element(document, where, "scenes", [](const json& scene, const std::string& place) {
        check_members(scene, place, {{"nodes", Type::Indices}});
    });
    for (const char* section : {"images", "textures", "samplers", "materials", "animations", "skins",
                                "cameras", "extensions", "extras"}) {
        document.erase(section);
    }
    return document;
}

}  // namespace rtu::model

#include "model/gltf_document.hpp"

#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/error.hpp"
#include "model/gltf_buffers.hpp"
#include "model/gltf_container.hpp"
#include "model/gltf_json.hpp"
#include "model/one_line.hpp"

namespace rtu::model {

namespace {

/// The buffers that wait to be fetched, by the name that stands in the document instead of their URI.
using NamedBuffers = std::map<std::string, BufferBytes>;

/// tinygltf sees no file: it "opens" the buffers that have been loaded already, and takes them without a
/// copy.
tinygltf::FsCallbacks callbacks_for(NamedBuffers& buffers) {
    tinygltf::FsCallbacks callbacks{};
    callbacks.user_data = &buffers;
    callbacks.FileExists = [](const std::string& name, void* data) {
        return static_cast<NamedBuffers*>(data)->contains(name);
    };
    callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& name,
                                 void* data) {
        *out = std::move(static_cast<NamedBuffers*>(data)->at(name));
        return true;
    };
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                  void*) { return false; };
    return callbacks;
}

/// Gives every buffer a URI that is its place in the document.
NamedBuffers name_buffers(nlohmann::json& document, std::vector<BufferBytes> buffers) {
    NamedBuffers named;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string name = fmt::format("buffer{}", i);
        document["buffers"][i]["uri"] = name;
        named.emplace(name, std::move(buffers[i]));
    }
    return named;
}

tinygltf::Model parse_document(const std::string& text, NamedBuffers buffers, const std::string& name) {
    tinygltf::Model model;
    std::string error;
    std::string warning;
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks(callbacks_for(buffers));
    bool is_read = false;
    try {
        is_read =
            reader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                       static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE);
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    // Some errors are only told and not returned.
    if (!is_read || !error.empty()) {
        throw Error("{}: {}", name, one_line(error.empty() ? "cannot be read as glTF" : error));
    }
    return model;
}

}  // namespace

tinygltf::Model load_gltf_document(const std::filesystem::path& file) {
    const std::string name = one_line(file.string());
    GltfContainer container = read_gltf_container(file);
    nlohmann::json document = parse_gltf_json(container.json, name);
    container.json = {};
    NamedBuffers buffers =
        name_buffers(document, load_gltf_buffers(document, std::move(container.binary_chunk), file));
    const std::string text = document.dump();
    document = nullptr;
    return parse_document(text, std::move(buffers), name);
}

}  // namespace rtu::model

#include "model/gltf_accessor.hpp"

#include <bit>
#include <cstddef>
#include <cstring>

#include "model/error.hpp"

namespace rtu::model {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are read as they lie in the file");

/// Equally spaced elements in a buffer; `first` is null where all of them are zero.
struct Elements {
    const unsigned char* first = nullptr;
    std::size_t stride_bytes = 0;

    [[nodiscard]] const unsigned char* at(std::size_t i) const { return first + i * stride_bytes; }
};

/// Finds `count` elements in a buffer view and checks that they lie within it, and it within its buffer.
/// Nothing overflows: the document's numbers are below 2^32.
Elements locate(const tinygltf::Model& model, int view_index, std::size_t offset_bytes, std::size_t count,
                std::size_t element_bytes, const std::string& where) {
    const auto view_number = std::size_t(view_index);
    if (view_number >= model.bufferViews.size()) {
        throw Error("{}: bufferView {} does not exist, the file has {}", where, view_number,
                    model.bufferViews.size());
    }
    const tinygltf::BufferView& view = model.bufferViews[view_number];
    const auto buffer_number = std::size_t(view.buffer);
    if (buffer_number >= model.buffers.size()) {
        throw Error("{}: buffer {} of bufferView {} does not exist, the file has {}", where, buffer_number,
                    view_number, model.buffers.size());
    }
    const std::vector<unsigned char>& bytes = model.buffers[buffer_number].data;
    if (view.byteOffset + view.byteLength > bytes.size()) {
        throw Error("{}: bufferView {} ends at byte {} of buffer {}, which has {}", where, view_number,
                    view.byteOffset + view.byteLength, buffer_number, bytes.size());
    }
    const std::size_t stride_bytes = view.byteStride == 0 ? element_bytes : view.byteStride;
    if (stride_bytes < element_bytes) {
        throw Error("{}: the byteStride of bufferView {} is {}, below the element size of {}", where,
                    view_number, stride_bytes, element_bytes);
    }
    const std::size_t end_bytes = count == 0 ? 0 : offset_bytes + (count - 1) * stride_bytes + element_bytes;
    if (end_bytes > view.byteLength) {
        throw Error("{}: its {} elements end at byte {} of bufferView {}, which has {}", where, count,
                    end_bytes, view_number, view.byteLength);
    }
    return {bytes.data() + view.byteOffset + offset_bytes, stride_bytes};
}

template <class T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

template <class T>
std::uint32_t load_unsigned(const unsigned char* bytes) {
    return load<T>(bytes);
}

using LoadIndex = std::uint32_t (*)(const unsigned char*);

/// How to load an index, and null for a component type that is none.
LoadIndex index_loader(int component_type) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load_unsigned<std::uint8_t>;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load_unsigned<std::uint16_t>;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return load_unsigned<std::uint32_t>;
        default:
            return nullptr;
    }
}

std::size_t component_bytes(int component_type) {
    return std::size_t(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

void check_type(const tinygltf::Accessor& accessor, AccessorUse use, const std::string& where) {
    if (use == AccessorUse::Positions &&
        (accessor.type != TINYGLTF_TYPE_VEC3 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)) {
        throw Error(
            "{}: expected positions of type VEC3 and componentType 5126 (float), found componentType {}{}",
            where, accessor.componentType, accessor.type == TINYGLTF_TYPE_VEC3 ? "" : ", not VEC3");
    }
    if (use == AccessorUse::Indices &&
        (accessor.type != TINYGLTF_TYPE_SCALAR || index_loader(accessor.componentType) == nullptr)) {
        throw Error(
            "{}: expected indices of type SCALAR and componentType 5121, 5123 or 5125 (unsigned), "
            "found componentType {}{}",
            where, accessor.componentType, accessor.type == TINYGLTF_TYPE_SCALAR ? "" : ", not SCALAR");
    }
}

std::string place(int index, const std::string& where) {
    return fmt::format("{}, accessor {}", where, index);
}

const tinygltf::Accessor& checked_accessor(const tinygltf::Model& model, int index, AccessorUse use,
                                           const std::string& where) {
    if (std::size_t(index) >= model.accessors.size()) {
        throw Error("{} does not exist, the file has {}", where, model.accessors.size());
    }
    const tinygltf::Accessor& accessor = model.accessors[std::size_t(index)];
    check_type(accessor, use, where);
    if (accessor.bufferView < 0 && accessor.count > max_dataless_elements) {
        throw Error("{}: expected at most {} elements without a bufferView, found {}", where,
                    max_dataless_elements, accessor.count);
    }
    return accessor;
}

std::size_t element_bytes(const tinygltf::Accessor& accessor, AccessorUse use) {
    return component_bytes(accessor.componentType) * (use == AccessorUse::Positions ? 3 : 1);
}

Elements base_elements(const tinygltf::Model& model, const tinygltf::Accessor& accessor, AccessorUse use,
                       const std::string& where) {
    return accessor.bufferView < 0 ? Elements{}
                                   : locate(model, accessor.bufferView, accessor.byteOffset, accessor.count,
                                            element_bytes(accessor, use), where);
}

/// Overwrites the elements that the accessor's sparse part lists.
template <class T, class Load>
void apply_sparse(std::vector<T>& values, const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                  AccessorUse use, Load load_value, const std::string& where) {
    const auto& sparse = accessor.sparse;
    const LoadIndex load_index = index_loader(sparse.indices.componentType);
    if (load_index == nullptr) {
        throw Error("{}: expected sparse indices of componentType 5121, 5123 or 5125 (unsigned), found {}",
                    where, sparse.indices.componentType);
    }
    const auto count = std::size_t(sparse.count);
    const Elements indices =
        locate(model, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), count,
               component_bytes(sparse.indices.componentType), where + ", sparse indices");
    const Elements replacements =
        locate(model, sparse.values.bufferView, std::size_t(sparse.values.byteOffset), count,
               element_bytes(accessor, use), where + ", sparse values");
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t target = load_index(indices.at(i));
        if (target >= values.size()) {
            throw Error("{}: sparse index {} is {}, expected below {}", where, i, target, values.size());
        }
        values[target] = load_value(replacements.at(i));
    }
}

template <class T, class Load>
std::vector<T> read_elements(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                             AccessorUse use, Load load_value, const std::string& where) {
    const Elements base = base_elements(model, accessor, use, where);
    std::vector<T> values(accessor.count);
    if (base.first != nullptr) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = load_value(base.at(i));
        }
    }
    if (accessor.sparse.isSparse) {
        apply_sparse(values, model, accessor, use, load_value, where);
    }
    return values;
}

}  // namespace

std::uint64_t checked_count(const tinygltf::Model& model, int index, AccessorUse use,
                            const std::string& where) {
    const tinygltf::Accessor& accessor = checked_accessor(model, index, use, place(index, where));
    static_cast<void>(base_elements(model, accessor, use, place(index, where)));
    return accessor.count;
}

std::vector<Vec3> read_positions(const tinygltf::Model& model, int index, const std::string& where) {
    const std::string here = place(index, where);
    const tinygltf::Accessor& accessor = checked_accessor(model, index, AccessorUse::Positions, here);
    std::vector<Vec3> positions =
        read_elements<Vec3>(model, accessor, AccessorUse::Positions, load<Vec3>, here);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!is_finite(positions[i])) {
            throw Error("{}: position {} is ({}, {}, {}), expected finite numbers", here, i, positions[i].x,
                        positions[i].y, positions[i].z);
        }
    }
    return positions;
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int index, const std::string& where) {
    const std::string here = place(index, where);
    const tinygltf::Accessor& accessor = checked_accessor(model, index, AccessorUse::Indices, here);
    return read_elements<std::uint32_t>(model, accessor, AccessorUse::Indices,
                                        index_loader(accessor.componentType), here);
}

}  // namespace rtu::model

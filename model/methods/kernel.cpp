#include "model/methods/kernel.hpp"

#include <hwy/highway.h>

namespace rtu::model::methods {

std::string_view name_of(Form form) {
    switch (form) {
        case Form::Single:
            return "single";
        case Form::Rays:
            return "rays";
        case Form::Triangles:
            return "triangles";
        case Form::Pairs:
            break;
    }
    return "pairs";
}

float* PreparedTriangles::reserve(std::size_t size) {
    if (size > capacity) {
        values = hwy::AllocateAligned<float>(size);
        capacity = size;
    }
    return values.get();
}

}  // namespace rtu::model::methods

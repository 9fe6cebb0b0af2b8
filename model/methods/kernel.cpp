#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "model/methods/exact.hpp"
#include "model/methods/havel_herout_sse4.hpp"
#include "model/methods/kernel_groups.hpp"

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

namespace {

// Where methods stand in all_methods().
std::size_t rank(const Kernel& kernel) {
    const auto methods = all_methods();
    return std::size_t(
        std::ranges::find(methods, kernel.method.name, [](const Method& m) { return m.info.name; }) -
        methods.begin());
}

}  // namespace

const std::vector<Kernel>& all_kernels() {
    static const std::vector<Kernel> kernels = [] {
        std::vector<Kernel> all;
        add_plane_kernels(all);
        add_volume_kernels(all);
        add_shear_kernels(all);
        for (const Kernel& kernel : havel_herout_sse4_kernels()) all.push_back(kernel);
        for (const Kernel& kernel : exact_kernels()) all.push_back(kernel);
        std::ranges::stable_sort(all, {}, rank);
        return all;
    }();
    return kernels;
}

std::string_view instruction_set() {
    // The best of those that the kernels are compiled for: the lowest bit.
    const auto usable = hwy::SupportedTargets() & HWY_TARGETS;
    return hwy::TargetName(usable & -usable);
}

float* PreparedTriangles::reserve(std::size_t size) {
    if (size > capacity) {
        values = hwy::AllocateAligned<float>(size);
        capacity = size;
    }
    return values.get();
}

}  // namespace rtu::model::methods

#include "model/methods/method.hpp"

#include <algorithm>
#include <vector>

#include "model/methods/contracted.hpp"
#include "model/methods/exact.hpp"
#include "model/methods/havel_herout_sse4.hpp"
#include "model/methods/single_call-inl.hpp"

namespace rtu::model::methods {

std::span<const Method> all_methods(Contraction contraction) {
    static const std::vector<Method> methods = [] {
        std::vector<Method> all = RTU_TARGET::calls_of(RTU_TARGET::AllMethods());
        for (const Method& method : havel_herout_sse4_methods()) {
            const auto scalar = std::find_if(all.begin(), all.end(), [](const Method& m) {
                return m.info.name == RTU_TARGET::HavelHerout::info.name;
            });
            all.insert(scalar + 1, method);
        }
        all.push_back({exact_info, &test_exactly});
        return all;
    }();
    return contraction == Contraction::Off ? std::span(methods) : contracted_methods();
}

const Method* find_method(std::string_view name, Contraction contraction) {
    const auto methods = all_methods(contraction);
    const auto found =
        std::find_if(methods.begin(), methods.end(), [&](const Method& m) { return m.info.name == name; });
    return found == methods.end() ? nullptr : &*found;
}

}  // namespace rtu::model::methods

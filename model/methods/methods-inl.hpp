// Every method, for the instruction set that is being compiled (see target.hpp).

#include "model/methods/target.hpp"

#if defined(RTU_METHODS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RTU_METHODS_INL
#undef RTU_METHODS_INL
#else
#define RTU_METHODS_INL
#endif

// Each stands on those before it.
// clang-format off
#include "model/methods/numeric-inl.hpp"
#include "model/methods/lanes-inl.hpp"
#include "model/methods/result-inl.hpp"
#include "model/methods/badouel.hpp"
#include "model/methods/baldwin_weber.hpp"
#include "model/methods/embree_moller.hpp"
#include "model/methods/havel_herout.hpp"
#include "model/methods/kensler_shirley.hpp"
#include "model/methods/moller_trumbore.hpp"
#include "model/methods/moller_trumbore_deferred.hpp"
#include "model/methods/shevtsov.hpp"
#include "model/methods/snyder_barr.hpp"
#include "model/methods/wald.hpp"
#include "model/methods/woop.hpp"
// clang-format on

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

template <class... Methods>
struct MethodList {};

/// In the order of their publication.
using AllMethods =
    MethodList<SnyderBarr, Badouel, MollerTrumbore, MollerTrumboreDeferred, Wald, KenslerShirley, Shevtsov,
               ShevtsovDistanceFirst, HavelHerout, EmbreeMoller, BaldwinWeber, Woop>;

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();

#endif

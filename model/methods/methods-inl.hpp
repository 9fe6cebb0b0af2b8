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
#include "model/methods/edge_weights-inl.hpp"
#include "model/methods/badouel.hpp"
#include "model/methods/baldwin_weber.hpp"
#include "model/methods/edge_plane.hpp"
#include "model/methods/embree_moller.hpp"
#include "model/methods/embree_plucker.hpp"
#include "model/methods/havel_herout.hpp"
#include "model/methods/kensler_shirley.hpp"
#include "model/methods/moller_trumbore.hpp"
#include "model/methods/moller_trumbore_deferred.hpp"
#include "model/methods/plucker.hpp"
#include "model/methods/plucker_precomputed.hpp"
#include "model/methods/plucker_two_cross.hpp"
#include "model/methods/segura_feito.hpp"
#include "model/methods/shevtsov.hpp"
#include "model/methods/snyder_barr.hpp"
#include "model/methods/wald.hpp"
#include "model/methods/woop.hpp"
#include "model/methods/woop_double.hpp"
#include "model/methods/settle-inl.hpp"
#include "model/methods/woop_exact.hpp"
#include "model/methods/woop_top_left.hpp"
// clang-format on

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

template <class... Methods>
struct MethodList {};

/// In the order of their publication, ours last.
using AllMethods = MethodList<SnyderBarr, Badouel, MollerTrumbore, PluckerPrecomputed, Plucker,
                              PluckerTwoCross, MollerTrumboreDeferred, SeguraFeito, Wald, KenslerShirley,
                              Shevtsov, ShevtsovDistanceFirst, HavelHerout, Woop, WoopDouble, EmbreeMoller,
                              EmbreePlucker, BaldwinWeber, EdgePlane, WoopTopLeft, WoopExact>;

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();

#endif

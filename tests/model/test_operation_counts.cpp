#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "model/methods/method.hpp"
#include "model/methods/operation_counts.hpp"

namespace rtu::model::methods {
namespace {

OperationCounts times(std::uint32_t n, const OperationCounts& c) {
    OperationCounts sum;
    for (std::uint32_t i = 0; i < n; ++i) sum = sum + c;
    return sum;
}

void expect_mul_add(const OperationCounts& counts, std::uint32_t mul, std::uint32_t add) {
    EXPECT_EQ(counts.mul, mul);
    EXPECT_EQ(counts.add, add);
    EXPECT_EQ(counts.div, 0);
}

TEST(OperationCounts, AreThoseOfTheExpression) {
    Counted::tally() = {};
    const Counted a(2.0F), b(3.0F), c(4.0F);
    const Counted sum = a * b + c * a - b;  // one product fuses into each of one addition
    EXPECT_EQ(sum.value(), 11);
    EXPECT_EQ(Counted::tally().own, (OperationCounts{.mul = 2, .add = 2, .fusable = 1}));
    EXPECT_TRUE(sum > Counted::bound(1) * b);
    EXPECT_EQ(Counted::tally().own, (OperationCounts{.mul = 2, .add = 2, .fusable = 1}));
    EXPECT_EQ(Counted::tally().interval, (OperationCounts{.mul = 1, .compare = 1}));
    (void)flip_sign(magnitude(a / b), -c);
    EXPECT_EQ(Counted::tally().own, (OperationCounts{.mul = 2, .add = 2, .div = 1, .sign = 3, .fusable = 1}));
}

TEST(OperationCounts, ExistForEveryMethodButTheMachinesOwn) {
    for (const Method& method : all_methods()) {
        const bool is_template = method.info.name != "exact" && method.info.name != "havel_herout_sse4";
        EXPECT_EQ(counts_of(method.info.name) != nullptr, is_template) << method.info.name;
    }
    EXPECT_EQ(counts_of("no such method"), nullptr);
}

TEST(OperationCounts, OfWoopAreTheKnownOnes) {
    const MethodCounts& woop = *counts_of("woop");
    expect_mul_add(woop.single.full, 16, 22);
    EXPECT_EQ(woop.single.full.fusable, 11);  // so 11 additions, 5 multiplications, 11 fused
    expect_mul_add(woop.single.rejected, 12, 18);
    expect_mul_add(times(2, woop.single.full), 32, 44);
    expect_mul_add(woop.pair->both_full, 26, 33);
    EXPECT_EQ(woop.pair->both_full.fusable, 17);
    expect_mul_add(woop.pair->one_full, 22, 29);
    expect_mul_add(woop.pair->rejected, 18, 25);
}

TEST(OperationCounts, OfOurPairAreNotMoreThanOfWoops) {
    const PairCounts &ours = *counts_of("woop_top_left")->pair, &woop = *counts_of("woop")->pair;
    EXPECT_EQ(ours.both_full.mul, woop.both_full.mul);
    EXPECT_EQ(ours.one_full.mul, woop.one_full.mul);
    EXPECT_LE(ours.one_full.add, woop.one_full.add + 1);  // the common edge is subtracted twice
    EXPECT_LE(ours.both_full.add, woop.both_full.add + 1);
}

TEST(OperationCounts, OfPairsAreLessThanOfTwoTriangles) {
    int pairs = 0;
    for (const MethodCounts& method : operation_counts()) {
        if (!method.pair) continue;
        ++pairs;
        EXPECT_LT(method.pair->both_full.mul, 2 * method.single.full.mul) << method.name;
        EXPECT_LT(method.pair->both_full.add, 2 * method.single.full.add) << method.name;
        EXPECT_LT(method.pair->both.mul, 2 * method.single.hit.mul) << method.name;
    }
    EXPECT_EQ(pairs, 7);
}

TEST(OperationCounts, GrowFromTheFirstExitToTheHit) {
    for (const MethodCounts& method : operation_counts()) {
        const SingleCounts& one = method.single;
        EXPECT_LE(one.rejected.mul + one.rejected.add, one.miss.mul + one.miss.add) << method.name;
        EXPECT_LE(one.miss.mul + one.miss.add, one.hit.mul + one.hit.add) << method.name;
        EXPECT_GE(one.hit.div, 1) << method.name;
        EXPECT_GT(one.hit.compare + one.hit.sign, 3) << method.name;
    }
}

std::string text(const OperationCounts& c) {
    std::ostringstream out;
    out << c.mul << ' ' << c.add << ' ' << c.div << ' ' << c.compare << ' ' << c.sign << ' ' << c.fusable;
    return out.str();
}

// As docs/methods.md has them.
std::vector<std::string> documented_rows() {
    std::vector<std::string> rows;
    for (const MethodCounts& m : operation_counts())
        rows.push_back("| " + std::string(m.name) + " | " + text(m.precomputation) + " | " +
                       text(m.single.rejected) + " | " + text(m.single.miss) + " | " + text(m.single.full) +
                       " | " + text(m.single.hit) + " |");
    for (const MethodCounts& m : operation_counts())
        if (m.pair)
            rows.push_back("| " + std::string(m.name) + " | " + text(times(2, m.single.full)) + " | " +
                           text(m.pair->rejected) + " | " + text(m.pair->one_full) + " | " +
                           text(m.pair->both_full) + " | " + text(m.pair->both) + " |");
    return rows;
}

TEST(OperationCounts, AreThoseOfTheDocumentation) {
    std::ifstream file(RTUSIM_SOURCE_DIR "/docs/methods.md");
    std::ostringstream page;
    page << file.rdbuf();
    for (const std::string& row : documented_rows())
        EXPECT_NE(page.str().find(row + "\n"), std::string::npos) << row;
}

}  // namespace
}  // namespace rtu::model::methods

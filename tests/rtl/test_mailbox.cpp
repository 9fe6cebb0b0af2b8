// The mailbox of the RTL beside the model's, and beside a list of the numbers looked up last.
#include <Vmailbox.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "model/mailbox.hpp"
#include "rtl_ref/harness/clock.hpp"
#include "vectors.hpp"

namespace rtu {
namespace {

using test::RandomBits;

constexpr std::uint32_t slot_count = 16, lane_count = 2, slot_bits = 4, number_bits = 28;

// What one lane does in a cycle.
struct Decision {
    std::uint32_t slot = 0;
    bool is_valid = false;
    bool is_first = false;
    bool looks_up = false;
    std::uint32_t number = 0;
};

// A ray's mailbox as a list: the numbers that were not found, of which the last few count.
struct RecentNumbers {
    std::deque<std::uint32_t> numbers;

    bool look_up(std::uint32_t number, std::uint32_t entries) {
        if (std::ranges::find(numbers, number) != numbers.end()) return true;
        numbers.push_back(number);
        if (numbers.size() > entries) numbers.pop_front();
        return false;
    }
};

// The unit, and what each slot's mailbox should hold.
class MailboxBench {
  public:
    explicit MailboxBench(std::uint32_t entries) : entries_(entries) {
        unit_.last_entry_i = std::uint8_t(entries - 1);
        drive({});
        unit_.rst_ni = 0;
        cycle();
        unit_.rst_ni = 1;
        for (auto& mailbox : model_) mailbox = model::Mailbox({model::MailboxKind::Recent, entries});
    }
    ~MailboxBench() { unit_.final(); }
    MailboxBench(const MailboxBench&) = delete;
    MailboxBench& operator=(const MailboxBench&) = delete;

    // Both lanes' decisions, whose slots were read in the cycle before; and what is read now.
    void decide(const std::array<Decision, lane_count>& decisions,
                const std::array<std::uint32_t, lane_count>& next_slots) {
        drive(decisions);
        unit_.read_slot_i = std::uint8_t(next_slots[0] | next_slots[1] << slot_bits);
        rtl::settle(unit_);
        for (std::uint32_t lane = 0; lane < lane_count; ++lane) check(decisions[lane], lane);
        rtl::clock_edge(unit_);
    }

    // One lookup on its own. A ray's first decision need not look anything up.
    bool look_up(std::uint32_t slot, std::uint32_t number) {
        decide({}, {slot, slot});
        decide({Decision{slot, true, false, true, number}, {}}, {});
        return was_found_;
    }
    void start_ray(std::uint32_t slot) {
        decide({}, {slot, slot});
        decide({Decision{slot, true, true, false, 0}, {}}, {});
    }

    std::uint64_t lookups = 0, hits = 0;

  private:
    void cycle() {
        rtl::settle(unit_);
        rtl::clock_edge(unit_);
    }

    void drive(const std::array<Decision, lane_count>& decisions) {
        std::uint32_t slots = 0, valid = 0, first = 0, lookup = 0;
        std::uint64_t numbers = 0;
        for (std::uint32_t lane = 0; lane < lane_count; ++lane) {
            const Decision& d = decisions[lane];
            slots |= d.slot << (lane * slot_bits);
            valid |= std::uint32_t(d.is_valid) << lane;
            first |= std::uint32_t(d.is_first) << lane;
            lookup |= std::uint32_t(d.looks_up) << lane;
            numbers |= std::uint64_t(d.number) << (lane * number_bits);
        }
        unit_.slot_i = std::uint8_t(slots);
        unit_.valid_i = std::uint8_t(valid);
        unit_.is_first_i = std::uint8_t(first);
        unit_.lookup_i = std::uint8_t(lookup);
        unit_.number_i = numbers;
    }

    void check(const Decision& d, std::uint32_t lane) {
        const bool is_found = (unit_.found_o >> lane & 1) != 0;
        if (d.is_valid && d.is_first) {
            model_[d.slot].clear(true);
            recent_[d.slot].numbers.clear();
        }
        if (!d.looks_up) {
            ASSERT_FALSE(is_found);
            return;
        }
        was_found_ = is_found;
        const auto leaf = model::NodeRef::leaf(std::uint64_t(d.number) * model::image_block_bytes, 1);
        const bool is_known = model_[d.slot].look_up(leaf) == model::MailboxAnswer::Known;
        ASSERT_EQ(was_found_, is_known) << "slot " << d.slot << ", number " << d.number;
        ASSERT_EQ(was_found_, recent_[d.slot].look_up(d.number, entries_));
        ++lookups;
        hits += was_found_ ? 1 : 0;
    }

    std::uint32_t entries_;
    Vmailbox unit_;
    std::array<model::Mailbox, slot_count> model_;
    std::array<RecentNumbers, slot_count> recent_;
    bool was_found_ = false;
};

// Numbers that a mailbox of so many entries finds about as often as not; any two differ in a bit or two.
std::uint32_t draw_number(RandomBits& random, std::uint32_t entries) {
    const std::uint32_t which = random.below(2 * entries + 1);
    if (random.one_in(4)) return 1U << (which % number_bits);
    return which;
}

std::array<std::uint32_t, lane_count> draw_slots(RandomBits& random,
                                                 const std::array<Decision, lane_count>& now) {
    const auto is_written = [&](std::uint32_t slot) {
        return std::ranges::any_of(now, [=](const Decision& d) { return d.is_valid && d.slot == slot; });
    };
    std::array<std::uint32_t, lane_count> slots{};
    do slots[0] = random.below(slot_count);
    while (is_written(slots[0]));
    do slots[1] = random.below(slot_count);
    while (is_written(slots[1]) || slots[1] == slots[0]);
    return slots;
}

TEST(MailboxRtl, AnswersAsTheModelAndAListOfTheLastNumbers) {
    RandomBits random(11);
    std::uint64_t lookups = 0, hits = 0;
    for (std::uint32_t entries = 1; entries <= model::max_mailbox_entries; ++entries) {
        MailboxBench bench(entries);
        std::array<bool, slot_count> has_ray{};
        std::array<Decision, lane_count> decisions{};
        const std::uint64_t wanted = test::vector_count(1'100'000) / model::max_mailbox_entries;
        while (bench.lookups < wanted && !testing::Test::HasFatalFailure()) {
            const auto next_slots = draw_slots(random, decisions);
            bench.decide(decisions, next_slots);
            for (std::uint32_t lane = 0; lane < lane_count; ++lane) {
                Decision& d = decisions[lane];
                d.slot = next_slots[lane];
                d.is_valid = !random.one_in(8);
                d.is_first = !has_ray[d.slot] || random.one_in(5 * entries);
                d.looks_up = d.is_valid && !random.one_in(4);
                d.number = draw_number(random, entries);
                has_ray[d.slot] |= d.is_valid;
            }
        }
        lookups += bench.lookups;
        hits += bench.hits;
    }
    EXPECT_GE(4 * hits, lookups);
    EXPECT_LE(4 * hits, 3 * lookups);
}

TEST(MailboxRtl, ForgetsTheNumberThatWentInFirst) {
    for (std::uint32_t entries = 1; entries <= model::max_mailbox_entries; ++entries) {
        MailboxBench bench(entries);
        bench.start_ray(3);
        for (std::uint32_t i = 0; i < entries; ++i) EXPECT_FALSE(bench.look_up(3, i));
        // A hit moves nothing: number 0 is still the first to go.
        for (std::uint32_t i = entries; i-- > 0;) EXPECT_TRUE(bench.look_up(3, i));
        EXPECT_FALSE(bench.look_up(3, entries));
        for (std::uint32_t i = 1; i <= entries; ++i) EXPECT_TRUE(bench.look_up(3, i));
        EXPECT_FALSE(bench.look_up(3, 0));
    }
}

TEST(MailboxRtl, ComparesEveryBit) {
    for (const std::uint32_t entries : {1U, 16U}) {
        MailboxBench bench(entries);
        for (std::uint32_t bit = 0; bit < number_bits; ++bit) {
            bench.start_ray(bit % slot_count);
            EXPECT_FALSE(bench.look_up(bit % slot_count, 0x5a5a5a5));
            EXPECT_FALSE(bench.look_up(bit % slot_count, 0x5a5a5a5 ^ 1U << bit));
        }
    }
}

TEST(MailboxRtl, IsEmptyForEveryRayAndEachSlotsOwn) {
    MailboxBench bench(8);
    for (std::uint32_t slot = 0; slot < slot_count; ++slot) {
        bench.start_ray(slot);
        for (std::uint32_t i = 0; i < 12; ++i) EXPECT_FALSE(bench.look_up(slot, i));
    }
    for (std::uint32_t slot = 0; slot < slot_count; ++slot) {
        EXPECT_TRUE(bench.look_up(slot, 11));
        bench.start_ray(slot);
        EXPECT_FALSE(bench.look_up(slot, 11));
    }
}

}  // namespace
}  // namespace rtu

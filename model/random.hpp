#pragma once

#include <array>
#include <cstdint>

namespace rtu::model {

/// Philox4x32-10 of [SMDS11]: 128 random bits that are a function of counter and key only.
[[nodiscard]] constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                                            std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t product0 = std::uint64_t{0xD2511F53} * counter[0];
        const std::uint64_t product1 = std::uint64_t{0xCD9E8D57} * counter[2];
        counter = {std::uint32_t(product1 >> 32) ^ counter[1] ^ key[0], std::uint32_t(product1),
                   std::uint32_t(product0 >> 32) ^ counter[3] ^ key[1], std::uint32_t(product0)};
        key[0] += 0x9E3779B9;  // the golden ratio's fraction
        key[1] += 0xBB67AE85;  // sqrt(3) - 1
    }
    return counter;
}

/// Random numbers of one ray: the same for the same (seed, purpose, index), whatever was drawn elsewhere.
class RandomStream {
  public:
    /// `purpose` keeps apart what is drawn for one index for different ends.
    RandomStream(std::uint64_t seed, std::uint32_t purpose, std::uint32_t index)
        : key_{std::uint32_t(seed), std::uint32_t(seed >> 32)}, purpose_(purpose), index_(index) {}

    /// Uniform in [0, 1), a multiple of 2^-24: exact in binary32.
    [[nodiscard]] float next() {
        if (used_ == 4) {
            bits_ = philox({block_++, index_, purpose_, 0}, key_);
            used_ = 0;
        }
        return float(bits_[used_++] >> 8) * 0x1p-24F;
    }

  private:
    std::array<std::uint32_t, 2> key_;
    std::uint32_t purpose_;
    std::uint32_t index_;
    std::uint32_t block_ = 0;
    std::uint32_t used_ = 4;
    std::array<std::uint32_t, 4> bits_{};
};

}  // namespace rtu::model

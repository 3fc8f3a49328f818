// SPDX-License-Identifier: MIT
#include "base/hand_over.hpp"

#include <array>
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace tribo {
namespace {

struct Numbers {
    std::array<std::uint64_t, 64> all{};
};

TEST(Snapshot, never_shows_half_of_a_state_nor_an_older_one) {
    constexpr std::uint64_t last = 50'000;
    Snapshot<Numbers> snapshot;
    std::thread writer([&] {
        for (std::uint64_t n = 1; n <= last; ++n) {
            snapshot.back().all.fill(n);
            snapshot.publish();
        }
    });
    std::uint64_t newest = 0;
    while (newest < last) {
        const Numbers& seen = snapshot.read();
        for (const std::uint64_t n : seen.all) ASSERT_EQ(n, seen.all[0]);
        ASSERT_GE(seen.all[0], newest);
        newest = seen.all[0];
    }
    writer.join();
}

TEST(Snapshot, gives_the_first_state_until_there_is_another) {
    Snapshot<int> snapshot(7);
    EXPECT_EQ(snapshot.read(), 7);
    snapshot.publish(8);
    snapshot.publish(9);
    EXPECT_EQ(snapshot.read(), 9);
    EXPECT_EQ(snapshot.read(), 9);
}

TEST(Loan, is_never_used_once_it_was_taken_back) {
    constexpr int rounds = 20'000;
    struct Item {
        std::array<int, 16> values{};
    };
    Loan<Item> loan;
    std::atomic<bool> over{false};
    std::atomic<int> torn{0}, used{0};
    std::thread user([&] {
        while (!over.load()) {
            const Loan<Item>::Use use(loan);
            if (use.get() == nullptr) continue;
            for (const int v : use.get()->values) torn += v != use.get()->values[0] ? 1 : 0;
            ++used;
        }
    });
    Item item;
    for (int n = 0; n < rounds || used.load() == 0; ++n) {
        loan.lend(&item);
        loan.lend(nullptr);
        item.values.fill(n);  // nobody looks: the thread sanitizer would see it
    }
    over = true;
    user.join();
    EXPECT_EQ(torn.load(), 0);
}

}  // namespace
}  // namespace tribo

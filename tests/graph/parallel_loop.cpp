#include "tasks/parallel_loop.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <thread>

#include "tasks/executor.hpp"

using namespace aquagraph;
using namespace aquagraph::tasks;

TEST_CASE("every block runs exactly once") {
    for (const int threads : {1, 2, 4, 8}) {
        Executor executor(threads);
        for (const std::size_t blocks : {0U, 1U, 2U, 7U, 64U, 1000U}) {
            std::vector<std::atomic<int>> count(blocks);
            executor.execute([&] { for_each_block(blocks, [&](std::size_t block) { ++count[block]; }); });
            for (const auto& times : count) REQUIRE(times == 1);
        }
    }
}

TEST_CASE("blocks taken together run exactly once, neighbours one after the other on one thread") {
    for (const int threads : {1, 2, 4}) {
        Executor executor(threads);
        for (const std::size_t blocks : {0U, 1U, 7U, 8U, 9U, 100U}) {
            std::vector<int> count(blocks);
            std::vector<std::thread::id> by(blocks);
            executor.execute([&] {
                for_each_block(blocks, 8, [&](std::size_t block) {
                    if (block % 8 != 0) CHECK(count[block - 1] == 1);
                    ++count[block];
                    by[block] = std::this_thread::get_id();
                });
            });
            for (std::size_t block = 0; block < blocks; ++block) {
                CHECK(count[block] == 1);
                CHECK(by[block] == by[block - block % 8]);
            }
        }
    }
}

TEST_CASE("one block, or one thread, stays on the calling thread and in order") {
    const std::thread::id self = std::this_thread::get_id();
    Executor executor(1);
    std::vector<std::size_t> order;
    executor.execute([&] {
        for_each_block(5, [&](std::size_t block) {
            CHECK(std::this_thread::get_id() == self);
            order.push_back(block);
        });
    });
    CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4});
}

TEST_CASE("it is what physics asks for") {
    const auto physics = [](const BlockLoop& loop, std::vector<double>& values) {
        loop(values.size(), [&](std::size_t block) { values[block] = 2.0 * static_cast<double>(block); });
    };
    Executor executor(2);
    std::vector<double> parallel(100);
    std::vector<double> serial(100);
    executor.execute([&] { physics(parallel_loop, parallel); });
    physics(serial_loop, serial);
    CHECK(parallel == serial);
}

TEST_CASE("reductions are bitwise the same on any number of threads") {
    std::mt19937_64 random(7);
    for (const std::size_t blocks : {1U, 2U, 3U, 5U, 64U, 255U, 1000U}) {
        std::vector<double> values(blocks);
        for (double& value : values)
            value = std::uniform_real_distribution<double>(-1, 1)(random) *
                    std::exp2(std::uniform_int_distribution<int>(-40, 40)(random));
        const auto map = [&](std::size_t block) { return values[block]; };
        const auto add = [](double a, double b) { return a + b; };
        const auto smaller = [](double a, double b) { return b < a ? b : a; };
        double reference = 0;
        for (const int threads : {1, 2, 4, 8}) {
            Executor executor(threads);
            std::vector<double> scratch(blocks);
            for (int trial = 0; trial < 20; ++trial)
                executor.execute([&] {
                    const double sum = reduce_blocks(blocks, 0.0, map, add, std::span(scratch));
                    if (threads == 1 && trial == 0) reference = sum;
                    REQUIRE(std::bit_cast<std::uint64_t>(sum) == std::bit_cast<std::uint64_t>(reference));
                    const double together = reduce_blocks(blocks, 0.0, map, add, std::span(scratch), 8);
                    REQUIRE(std::bit_cast<std::uint64_t>(together) == std::bit_cast<std::uint64_t>(reference));
                    const double least = reduce_blocks(blocks, 1e300, map, smaller);
                    REQUIRE(least == *std::min_element(values.begin(), values.end()));
                });
        }
        double magnitude = 0;
        double plain = 0;
        for (const double value : values) magnitude += std::abs(value), plain += value;
        CHECK(std::abs(reference - plain) <= 1e-15 * static_cast<double>(blocks) * magnitude);
    }
}

TEST_CASE("a reduction combines neighbours in pairs, in the order of the blocks") {
    const auto combine = [](const std::string& a, const std::string& b) {
        if (a.empty()) return b;
        return "(" + a + b + ")";
    };
    const auto map = [](std::size_t block) { return std::string(1, static_cast<char>('a' + block)); };
    Executor executor(2);
    executor.execute([&] {
        CHECK(reduce_blocks(0, std::string(), map, combine).empty());
        CHECK(reduce_blocks(1, std::string(), map, combine) == "a");
        CHECK(reduce_blocks(5, std::string(), map, combine) == "(((ab)(cd))e)");
    });
    std::vector<std::string> too_small(2);
    CHECK_THROWS_AS(reduce_blocks(3, std::string(), map, combine, too_small), std::invalid_argument);
}

#include "runtime/process/thread_pool.hpp"

#include <atomic>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace floornav {
namespace {

class ThreadPoolOf : public testing::TestWithParam<int> {};

TEST_P(ThreadPoolOf, RunsEveryPieceOnce) {
  ThreadPool pool(GetParam());
  EXPECT_EQ(pool.workers(), GetParam());
  for (int round = 0; round < 300; ++round) {
    const int count = round % 50;
    std::vector<int> calls(static_cast<std::size_t>(count), 0);
    pool.run(count, [&](int index, int) { ++calls[static_cast<std::size_t>(index)]; });
    EXPECT_EQ(calls, std::vector<int>(static_cast<std::size_t>(count), 1));
  }
}

TEST_P(ThreadPoolOf, GivesEachWorkerItsOwnScratch) {
  ThreadPool pool(GetParam());
  std::vector<long> sums(static_cast<std::size_t>(GetParam()),
                         0);  // not atomic: a worker's number is its own
  for (int round = 0; round < 100; ++round)
    pool.run(200, [&](int index, int worker) { sums.at(static_cast<std::size_t>(worker)) += index; });
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0L), 100L * 199 * 200 / 2);
}

TEST_P(ThreadPoolOf, StartsPiecesInOrder) {
  ThreadPool pool(GetParam());
  std::vector<int> last(static_cast<std::size_t>(GetParam()), -1);
  std::atomic<bool> ordered = true;
  pool.run(1000, [&](int index, int worker) {
    int& mine = last[static_cast<std::size_t>(worker)];
    if (index <= mine) ordered = false;
    mine = index;
  });
  EXPECT_TRUE(ordered);
}

TEST_P(ThreadPoolOf, ThrowsTheLowestPiecesExceptionAfterAllHaveRun) {
  ThreadPool pool(GetParam());
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> calls = 0;
    try {
      pool.run(20, [&](int index, int) {
        ++calls;
        if (index % 7 == 3) throw std::runtime_error(std::to_string(index));
      });
      ADD_FAILURE() << "no exception";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "3");
    }
    EXPECT_EQ(calls, 20);
  }
  int after = 0;
  pool.run(1, [&](int, int) { ++after; });
  EXPECT_EQ(after, 1);
}

TEST_P(ThreadPoolOf, APieceMayRunPiecesOfItsOwn) {
  ThreadPool pool(GetParam());
  std::vector<long> sums(static_cast<std::size_t>(GetParam()), 0);  // not atomic: see above
  for (int round = 0; round < 50; ++round)
    pool.run(7, [&](int outer, int) {
      pool.run(outer * 5, [&](int inner, int worker) {
        pool.run(2, [&](int, int) {});
        sums.at(static_cast<std::size_t>(worker)) += inner;
      });
    });
  long expected = 0;
  for (long outer = 0; outer < 7; ++outer) expected += 5 * outer * (5 * outer - 1) / 2;
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0L), 50 * expected);
}

TEST_P(ThreadPoolOf, AnInnerExceptionIsThrownWhereItsPiecesWereRun) {
  ThreadPool pool(GetParam());
  std::atomic<int> caught = 0;
  pool.run(9, [&](int, int) {
    try {
      pool.run(4, [](int inner, int) {
        if (inner == 2) throw std::runtime_error("inner");
      });
    } catch (const std::runtime_error&) {
      ++caught;
    }
  });
  EXPECT_EQ(caught, 9);
}

/// The one large piece cuts itself up: with two workers or more, all take part in it.
TEST(ThreadPool, IdleWorkersHelpWithAnInnerRun) {
  ThreadPool pool(3);
  std::atomic<int> arrived = 0;
  pool.run(1, [&](int, int) {
    pool.run(3, [&](int, int) {
      ++arrived;
      while (arrived < 3) std::this_thread::yield();  // none ends before all three have begun
    });
  });
  EXPECT_EQ(arrived, 3);
}

INSTANTIATE_TEST_SUITE_P(Workers, ThreadPoolOf, testing::Values(1, 2, 3, 8));

TEST(ThreadPool, EndsWithoutEverHavingRun) {
  for (int i = 0; i < 50; ++i) std::make_unique<ThreadPool>(4).reset();
}

TEST(ThreadPool, RefusesLessThanOneWorker) {
  EXPECT_THROW(ThreadPool(0), std::invalid_argument);
}

}  // namespace
}  // namespace floornav

// SPDX-License-Identifier: Apache-2.0
#include "hogel/table.h"

#include <gtest/gtest.h>

#include <thread>

#include "hogel/error.h"

namespace hogel {
namespace {

TEST(NearestWord, forgives_one_letter_of_three) {
    const std::vector<std::string> words{"raytrace", "zbuffer", "simplex", "simploid", "simplex3d", "epi"};
    EXPECT_EQ(nearest_word("zbufer", words), "zbuffer") << "left out";
    EXPECT_EQ(nearest_word("raytrrace", words), "raytrace") << "too many";
    EXPECT_EQ(nearest_word("simplax", words), "simplex") << "replaced";
    EXPECT_EQ(nearest_word("ratyrace", words), "raytrace") << "swapped";
    EXPECT_EQ(nearest_word("rsytrice", words), "raytrace") << "two of eight";
    EXPECT_EQ(nearest_word("epi", words), "epi");
    EXPECT_EQ(nearest_word("hologram", words), "");
}

TEST(NearestWord, of_equally_near_words_is_the_first) {
    EXPECT_EQ(nearest_word("cat", std::vector<std::string>{"bat", "hat"}), "bat");
}

TEST(NearestWord, is_also_the_one_that_was_begun_with_three_letters_or_more) {
    const std::vector<std::string> words{"raytrace", "simplex"};
    EXPECT_EQ(nearest_word("ray", words), "raytrace");
    EXPECT_EQ(nearest_word("ra", words), "");
}

TEST(NearestWord, shares_a_letter_with_the_word) {
    EXPECT_EQ(nearest_word("z", std::vector<std::string>{"x", "y"}), "");
    EXPECT_EQ(nearest_word("", std::vector<std::string>{"x"}), "");
    EXPECT_EQ(nearest_word("x", {}), "");
}

struct Fruit {
    std::string name;
    int weight = 0;
};

std::string message_of(const auto& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.what();
    }
    return "";
}

TEST(Table, finds_its_rows_by_name_in_the_order_in_which_they_came) {
    Table<Fruit> fruits("fruit", {{"pear", 170}, {"apple", 150}});
    fruits.add({"plum", 30});
    EXPECT_EQ(fruits.names(), (std::vector<std::string>{"pear", "apple", "plum"}));
    EXPECT_EQ(fruits.find("apple").weight, 150);
    EXPECT_EQ(fruits.look_up("plum")->weight, 30);
    EXPECT_EQ(fruits.look_up("cherry"), nullptr);
    const std::vector<Fruit> rows = fruits.rows();
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[2].name, "plum");
}

TEST(Table, says_which_rows_exist_and_which_one_may_have_been_meant) {
    const Table<Fruit> fruits("fruit", {{"pear", 170}, {"apple", 150}});
    EXPECT_EQ(message_of([&] { fruits.find("aple"); }),
              "no fruit 'aple' (did you mean 'apple'?); expected one of pear, apple");
    EXPECT_EQ(message_of([&] { fruits.find("zucchini"); }), "no fruit 'zucchini'; expected one of pear, apple");
}

TEST(Table, has_one_row_of_a_name) {
    Table<Fruit> fruits("fruit", {{"pear", 170}});
    EXPECT_EQ(message_of([&] { fruits.add({"pear", 1}); }), "there is a fruit 'pear' already");
    EXPECT_EQ(fruits.find("pear").weight, 170);
}

TEST(Table, rows_stay_where_they_are_while_other_threads_add_some) {
    Table<Fruit> fruits("fruit", {{"pear", 170}});
    const Fruit& pear = fruits.find("pear");
    {
        std::vector<std::jthread> threads;
        for (int thread = 0; thread < 4; ++thread)
            threads.emplace_back([&fruits, thread] {
                for (int i = 0; i < 100; ++i) {
                    fruits.add({std::to_string(thread) + " " + std::to_string(i), i});
                    EXPECT_EQ(fruits.find("pear").weight, 170);
                }
            });
    }
    EXPECT_EQ(fruits.rows().size(), 401u);
    EXPECT_EQ(&fruits.find("pear"), &pear);
    EXPECT_EQ(fruits.find("3 99").weight, 99);
}

}  // namespace
}  // namespace hogel

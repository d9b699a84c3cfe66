// SPDX-License-Identifier: Apache-2.0
#include "hogel/coding/arithmetic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hogel::coding {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A message of bits of three probabilities, symbols of four alphabets and raw numbers.
struct CodedModels {
    std::vector<BitModel> bits = std::vector<BitModel>(3);
    std::vector<SymbolModel> symbols{SymbolModel(1), SymbolModel(2), SymbolModel(5), SymbolModel(700)};
};
struct Item {
    int kind;  // 0 bit, 1 symbol, 2 raw
    std::size_t model;
    std::uint32_t value;
};

std::vector<Item> message(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Item> items;
    for (std::size_t i = 0; i < count; ++i) {
        const int kind = static_cast<int>(random() % 3);
        if (kind == 0) {
            const std::size_t model = random() % 3;
            items.push_back({kind, model, random() % 1000 < std::array{3u, 500u, 990u}[model]});
        } else if (kind == 1) {
            const std::size_t model = random() % 4, size = std::array{1, 2, 5, 700}[model];
            items.push_back({kind, model, static_cast<std::uint32_t>(std::min(random() % size, random() % size))});
        } else {
            const std::size_t bits = random() % 33;
            items.push_back({kind, bits, bits == 0 ? 0 : static_cast<std::uint32_t>(random()) >> (32 - bits)});
        }
    }
    return items;
}

Bytes encode(const std::vector<Item>& items) {
    ArithmeticEncoder encoder;
    CodedModels models;
    for (const Item& item : items)
        if (item.kind == 0)
            encoder.bit(models.bits[item.model], item.value != 0);
        else if (item.kind == 1)
            encoder.symbol(models.symbols[item.model], item.value);
        else
            encoder.raw(item.value, static_cast<int>(item.model));
    return encoder.finish();
}

// Returns the number of items that decode correctly before the decoder reports the end of the bytes.
std::size_t decoded(const std::vector<Item>& items, std::span<const std::uint8_t> bytes, bool* all_read = nullptr) {
    ArithmeticDecoder decoder(bytes);
    CodedModels models;
    std::size_t right = 0;
    for (const Item& item : items) {
        const std::uint32_t value = item.kind == 0 ? decoder.bit(models.bits[item.model])
                                    : item.kind == 1
                                        ? static_cast<std::uint32_t>(decoder.symbol(models.symbols[item.model]))
                                        : decoder.raw(static_cast<int>(item.model));
        if (decoder.ended()) return right;
        EXPECT_EQ(value, item.value) << "a decision was said to be certain and is not: item " << right;
        if (value != item.value) return right;
        ++right;
    }
    if (all_read) *all_read = decoder.all_read();
    return right;
}

TEST(Arithmetic, messages_come_back_whole) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const std::vector<Item> items = message(seed, seed);
        bool all_read = false;
        EXPECT_EQ(decoded(items, encode(items), &all_read), items.size());
        EXPECT_TRUE(all_read) << seed;
    }
}

TEST(Arithmetic, every_prefix_gives_what_it_determines_and_no_more) {
    const std::vector<Item> items = message(600, 11);
    const Bytes bytes = encode(items);
    std::size_t before = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const std::size_t now = decoded(items, std::span(bytes).first(length));
        EXPECT_GE(now, before);
        before = now;
    }
    EXPECT_LT(before, items.size()) << "the last byte was not needed";
    EXPECT_GT(before + 60, items.size());
}

// Repeating the last symbol of an alphabet brings `low` close to its maximum, so that carries propagate far.
TEST(Arithmetic, carries_run_through_long_rows_of_ones) {
    for (int last = 0; last < 64; ++last) {
        std::vector<Item> items(400, Item{2, 16, 0xFFFF});
        items.push_back({2, 32, 0xFFFFFFFFu - static_cast<std::uint32_t>(last)});
        items.insert(items.end(), 50, Item{0, 2, 1});
        items.push_back({1, 3, static_cast<std::uint32_t>(last)});
        EXPECT_EQ(decoded(items, encode(items)), items.size());
    }
}

TEST(Arithmetic, takes_little_more_than_the_entropy) {
    std::mt19937 random(2);
    const std::size_t count = 200000;
    ArithmeticEncoder bits, symbols;
    BitModel bit_model;
    SymbolModel symbol_model(16);
    double bit_entropy = 0, symbol_entropy = 0;
    const auto information = [](double p) { return -std::log2(p); };
    for (std::size_t i = 0; i < count; ++i) {
        const bool value = random() % 100 < 10;
        bits.bit(bit_model, value);
        bit_entropy += information(value ? 0.1 : 0.9);
        std::size_t symbol = 0;  // geometric distribution
        while (symbol < 15 && random() % 2) ++symbol;
        symbols.symbol(symbol_model, symbol);
        symbol_entropy += symbol < 15 ? static_cast<double>(symbol + 1) : 15;
    }
    const double bit_size = 8.0 * static_cast<double>(bits.finish().size());
    const double symbol_size = 8.0 * static_cast<double>(symbols.finish().size());
    EXPECT_LT(bit_size, 1.03 * bit_entropy);
    EXPECT_LT(symbol_size, 1.01 * symbol_entropy);
    EXPECT_GT(bit_size, 0.99 * bit_entropy);
    EXPECT_GT(symbol_size, 0.99 * symbol_entropy);
}

TEST(Arithmetic, hostile_bytes_stay_within_the_alphabets) {
    std::mt19937 random(8);
    for (int trial = 0; trial < 2000; ++trial) {
        Bytes bytes(random() % 40);
        for (std::uint8_t& byte : bytes) byte = trial % 4 == 0 ? 0xFF : static_cast<std::uint8_t>(random());
        ArithmeticDecoder decoder(bytes);
        CodedModels models;
        for (const Item& item : message(200, static_cast<unsigned>(trial))) {
            if (item.kind == 0) {
                decoder.bit(models.bits[item.model]);
            } else if (item.kind == 1) {
                EXPECT_LT(decoder.symbol(models.symbols[item.model]), models.symbols[item.model].count());
            } else {
                EXPECT_LT(decoder.raw(static_cast<int>(item.model)), std::uint64_t{1} << item.model);
            }
        }
    }
}

TEST(Arithmetic, a_flat_model_is_searched_as_it_is_summed) {
    for (std::size_t count : {1, 2, 3, 31, 32, 33, 700}) {
        SymbolModel model(count);
        std::mt19937 random(4);
        for (int i = 0; i < 5000; ++i) model.learn(random() % count);
        std::uint32_t sum = 0;
        for (std::size_t symbol = 0; symbol < count; ++symbol) {
            EXPECT_EQ(model.before(symbol), sum);
            EXPECT_EQ(model.find(sum), symbol);
            sum += model.frequency(symbol);
            EXPECT_EQ(model.find(sum - 1), symbol);
        }
        EXPECT_EQ(model.total(), sum);
    }
}

}  // namespace
}  // namespace hogel::coding

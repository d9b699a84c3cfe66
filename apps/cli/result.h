// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hogel::cli {

class ResultValue;
/// Names and values in display order.
using Result = std::vector<std::pair<std::string, ResultValue>>;
using ResultList = std::vector<ResultValue>;

/// Value in the --json output of a command: a boolean, an integer, a number, a text, a list or an object.
class ResultValue {
  public:
    ResultValue(bool value) : value_(value) {}
    template <std::unsigned_integral T>
    requires(!std::same_as<T, bool>) ResultValue(T value) : value_(static_cast<std::uint64_t>(value)) {}
    template <std::signed_integral T>
    ResultValue(T value) : value_(static_cast<std::int64_t>(value)) {}
    template <std::floating_point T>
    ResultValue(T value) : value_(static_cast<double>(value)) {}
    ResultValue(std::string value) : value_(std::move(value)) {}
    ResultValue(const char* value) : value_(std::string(value)) {}
    ResultValue(ResultList value) : value_(std::move(value)) {}
    ResultValue(Result value) : value_(std::move(value)) {}

    using Variant = std::variant<bool, std::int64_t, std::uint64_t, double, std::string, ResultList, Result>;
    const Variant& get() const { return value_; }

  private:
    Variant value_;
};

/// Returns a JSON object on several lines. Infinite numbers and NaN become null.
std::string to_json(const Result& result);

}  // namespace hogel::cli

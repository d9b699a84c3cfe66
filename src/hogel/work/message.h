// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "hogel/array.h"
#include "hogel/error.h"

namespace hogel::work {

/// Appends a number to a message, such as its index or a flag. MessageWriter::reserve() leaves room for it, so that
/// long messages are not copied.
inline void append_number(std::string& bytes, std::uint64_t number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}
/// Removes the last number of a message and returns it; returns 0 if the message is too short.
inline std::uint64_t take_last_number(std::string& bytes) {
    std::uint64_t number = 0;
    if (bytes.size() < sizeof number) return number;
    std::memcpy(&number, bytes.data() + bytes.size() - sizeof number, sizeof number);
    bytes.resize(bytes.size() - sizeof number);
    return number;
}

/// Serialises values into a message to another rank. All ranks run the same program.
class MessageWriter {
  public:
    template <class Value>
    requires std::is_trivially_copyable_v<Value>
    void put(const Value& value) { put(&value, 1); }
    template <class Value>
    void put(const std::vector<Value>& values) {
        put(values.size());
        put(values.data(), values.size());
    }
    template <class Value, std::size_t axes>
    void put(const Array<Value, axes>& array) {
        put(array.shape());
        put(array.data(), array.size());
    }
    std::string take() { return std::move(bytes_); }
    /// Reserves memory for `bytes` bytes and for the numbers that append_number() adds.
    void reserve(std::size_t bytes) { bytes_.reserve(bytes + 64); }

  private:
    template <class Value>
    requires std::is_trivially_copyable_v<Value>
    void put(const Value* values, std::size_t count) {
        bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
    }

    std::string bytes_;
};

/// Reads the values of a MessageWriter in the same order. Throws Error(internal) if the message is too short.
class MessageReader {
  public:
    explicit MessageReader(std::string_view bytes) : bytes_(bytes) {}

    template <class Value>
    requires std::is_trivially_copyable_v<Value> Value get() {
        Value value;
        get(&value, 1);
        return value;
    }
    template <class Value>
    std::vector<Value> get_vector() {
        const auto count = get<std::size_t>();
        require(count, sizeof(Value));
        std::vector<Value> values(count);
        get(values.data(), values.size());
        return values;
    }
    template <class Value, std::size_t axes>
    Array<Value, axes> get_array() {
        const auto shape = get<Shape<axes>>();
        Array<Value, axes> array(shape);
        get(array.data(), array.size());
        return array;
    }

  private:
    void require(std::size_t count, std::size_t size) const {
        if (count > bytes_.size() / size)
            throw Error(ErrorCode::internal, "a message from another rank is shorter than its header says");
    }
    template <class Value>
    void get(Value* values, std::size_t count) {
        require(count, sizeof(Value));
        if (count > 0) std::memcpy(static_cast<void*>(values), bytes_.data(), count * sizeof(Value));
        bytes_.remove_prefix(count * sizeof(Value));
    }

    std::string_view bytes_;
};

}  // namespace hogel::work

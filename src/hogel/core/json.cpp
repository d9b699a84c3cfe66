// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/json.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"

namespace hogel::core {
namespace {

using Json = nlohmann::json;

/// Iterator over a text that checks for a stop request at intervals.
class JsonText {
  public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    explicit JsonText(const char* position) : position_(position) {}
    reference operator*() const { return *position_; }
    JsonText& operator++() {
        constexpr std::uintptr_t interval = 1 << 18;
        if (reinterpret_cast<std::uintptr_t>(++position_) % interval == 0) throw_if_stopped();
        return *this;
    }
    bool operator==(const JsonText&) const = default;

  private:
    const char* position_;
};

/// Builds a document from parser events. The parser's own callbacks search the enclosing array after each element.
class JsonBuilder final : public nlohmann::json_sax<Json> {
  public:
    explicit JsonBuilder(const std::function<void(const std::string&)>& reject) : reject_(reject) {}
    Json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t&) override { return false; }  // not in text
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        const auto [entry, is_new] = open_.back()->get_ref<Json::object_t&>().emplace(std::move(name), nullptr);
        if (!is_new) {
            constexpr std::size_t max_length = 40;
            std::string shown = Json(entry->first).dump(-1, ' ', true, Json::error_handler_t::replace);
            if (shown.size() > max_length) shown = shown.substr(0, max_length) + " ...";
            reject_(fmt::format("the key {} occurs twice in one object of its JSON", shown));
        }
        member_ = &entry->second;
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
        if (dynamic_cast<const Json::parse_error*>(&error) == nullptr) reject_("its JSON has a number out of range");
        reject_(fmt::format("its JSON has an error at byte {}", position));
        return false;
    }

  private:
    Json* insert(Json&& value) {
        if (++values_ > max_json_values) reject_(fmt::format("its JSON has more than {} values", max_json_values));
        if (open_.empty()) return &(root_ = std::move(value));
        if (open_.back()->is_object()) return &(*member_ = std::move(value));
        return &open_.back()->get_ref<Json::array_t&>().emplace_back(std::move(value));
    }
    bool add(Json&& value) {
        insert(std::move(value));
        return true;
    }
    bool open(Json&& value) {
        if (open_.size() == max_json_depth) reject_(fmt::format("its JSON nests deeper than {}", max_json_depth));
        open_.push_back(insert(std::move(value)));
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    const std::function<void(const std::string&)>& reject_;
    Json root_;
    std::vector<Json*> open_;  ///< enclosing arrays and objects
    Json* member_ = nullptr;   ///< destination of the next value of an object
    std::size_t values_ = 0;
};

}  // namespace

nlohmann::json parse_json(std::string_view text, const std::function<void(const std::string& fault)>& reject) {
    JsonBuilder builder(reject);
    const bool is_whole = Json::sax_parse(JsonText(text.data()), JsonText(text.data() + text.size()), &builder);
    if (!is_whole) throw Error(ErrorCode::internal, "parse_json(): a fault was not rejected");
    return builder.take();
}

}  // namespace hogel::core

// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/file_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>

#include "hogel/core/lower_case.h"
#include "hogel/error.h"
#include "hogel/image/picture_formats.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t max_digits = 18;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number in a name: its range of characters and its value.
struct NameNumber {
    std::size_t begin, end;
    std::int64_t value;
};

std::vector<NameNumber> numbers_in(const std::string& name) {
    std::vector<NameNumber> numbers;
    for (std::size_t i = 0; i < name.size();) {
        if (!is_digit(name[i])) {
            ++i;
            continue;
        }
        const std::size_t first = i;
        const bool negative = first > 1 && name[first - 1] == '-' && (name[first - 2] == '_' || name[first - 2] == ' ');
        std::int64_t value = 0;
        for (; i < name.size() && is_digit(name[i]) && i - first < max_digits; ++i)
            value = 10 * value + (name[i] - '0');
        numbers.push_back({negative ? first - 1 : first, i, negative ? -value : value});
    }
    return numbers;
}

// Splits a name into its shape and its numbers.
std::pair<std::string, std::vector<std::int64_t>> parse(const std::string& name) {
    std::string shape;
    std::vector<std::int64_t> values;
    std::size_t done = 0;
    for (const NameNumber& number : numbers_in(name)) {
        shape += name.substr(done, number.begin - done) + '#';
        done = number.end;
        values.push_back(number.value);
    }
    return {shape + name.substr(done), values};
}

/// Returns whether number i of the names determines number k.
bool follows_from(const std::vector<NumberedFile>& files, std::size_t k, std::size_t i) {
    std::map<std::int64_t, std::int64_t> values;
    return std::ranges::all_of(files, [&](const NumberedFile& file) {
        return values.emplace(file.numbers[i], file.numbers[k]).first->second == file.numbers[k];
    });
}

std::vector<std::size_t> varying_of(const std::vector<NumberedFile>& files) {
    std::vector<std::size_t> varying;
    for (std::size_t k = 0; k < files.front().numbers.size(); ++k) {
        const bool varies =
            std::ranges::any_of(files, [&](const auto& file) { return file.numbers[k] != files.front().numbers[k]; });
        if (varies && std::ranges::none_of(varying, [&](std::size_t i) { return follows_from(files, k, i); }))
            varying.push_back(k);
    }
    return varying;
}

// Returns the distinct values of a number, ascending. Throws unless they are evenly spaced.
std::vector<std::int64_t> steps(const NumberedFiles& group, std::size_t number) {
    std::vector<std::int64_t> values;
    for (const NumberedFile& file : group.files) values.push_back(file.numbers[number]);
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    for (std::size_t i = 2; i < values.size(); ++i)
        if (values[i] - values[i - 1] != values[1] - values[0])
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: the numbers go on from {} to {}, but by steps of {} before; views are missing",
                                    group.files.front().path.parent_path().string(), values[i - 1], values[i],
                                    values[1] - values[0]));
    return values;
}

// Returns the name of a missing file: another file's name with two numbers replaced at their widths.
std::string name_with(const std::string& name, std::size_t a, std::int64_t a_value, std::size_t b,
                      std::int64_t b_value) {
    std::string replaced;
    std::size_t done = 0;
    const std::vector<NameNumber> numbers = numbers_in(name);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto [begin, end, value] = numbers[i];
        replaced += name.substr(done, begin - done);
        replaced += i == a   ? fmt::format("{:0{}}", a_value, end - begin)
                    : i == b ? fmt::format("{:0{}}", b_value, end - begin)
                             : name.substr(begin, end - begin);
        done = end;
    }
    return replaced + name.substr(done);
}

struct NumberInName {
    std::size_t index;
    std::int64_t value;
};

[[noreturn]] void fail_missing(const NumberedFiles& group, const NumberInName& row, const NumberInName& column,
                               const PictureGrid& grid) {
    const fs::path& other = group.files.front().path;
    const std::string name = name_with(other.stem().string(), row.index, row.value, column.index, column.value);
    throw Error(ErrorCode::bad_input, fmt::format("{}: a view is missing; there are {} of {}x{}",
                                                  (other.parent_path() / name).string() + other.extension().string(),
                                                  group.files.size(), grid.columns, grid.rows));
}

// Returns whether the name denotes derived pictures instead of camera views: disparity, depth, labels, thumbnails.
bool is_map(const std::string& shape) {
    const std::string name = core::lower_case(shape);
    for (const char* word : {"disp", "depth", "label", "mask", "objectid", "normal", "thumb", "preview"})
        if (name.find(word) != std::string::npos) return true;
    return false;
}

}  // namespace

std::vector<NumberedFiles> numbered_pictures(const fs::path& folder) {
    std::map<std::string, NumberedFiles> groups;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        const image::PictureFormat* format = image::format_by_extension(entry.path());
        if (name.starts_with('.') || format == nullptr || !entry.is_regular_file(error)) continue;
        auto [shape, numbers] = parse(entry.path().stem().string());
        shape += entry.path().extension().string();
        NumberedFiles& group = groups[shape];
        group.shape = shape;
        group.files.push_back({entry.path(), std::move(numbers)});
    }
    std::vector<NumberedFiles> list;
    for (auto& [shape, group] : groups) {
        std::ranges::sort(group.files, {}, &NumberedFile::path);
        group.varying = varying_of(group.files);
        list.push_back(std::move(group));
    }
    std::ranges::stable_sort(list, std::ranges::greater(),
                             [](const auto& group) { return std::pair(!is_map(group.shape), group.files.size()); });
    return list;
}

PictureGrid in_rows_and_columns(const NumberedFiles& group, std::size_t row_number, std::size_t column_number) {
    const std::vector<std::int64_t> rows = steps(group, row_number), columns = steps(group, column_number);
    // Sorted list instead of an array: numbers that differ in every name would make a grid of (number of files)².
    std::vector<std::pair<std::size_t, const NumberedFile*>> indexed;
    const auto index_of = [](const std::vector<std::int64_t>& values, std::int64_t value) {
        return static_cast<std::size_t>(std::ranges::lower_bound(values, value) - values.begin());
    };
    for (const NumberedFile& file : group.files)
        indexed.emplace_back(
            index_of(rows, file.numbers[row_number]) * columns.size() + index_of(columns, file.numbers[column_number]),
            &file);
    std::ranges::stable_sort(indexed, {}, [](const auto& entry) { return entry.first; });
    PictureGrid grid{rows.size(), columns.size(), {}};
    for (std::size_t i = 0; i < indexed.size(); ++i) {
        const auto& [index, file] = indexed[i];
        if (i > 0 && index == indexed[i - 1].first)
            throw Error(ErrorCode::bad_input, fmt::format("{}: is the same view as {}", file->path.string(),
                                                          indexed[i - 1].second->path.filename().string()));
        if (index != i)
            fail_missing(group, {row_number, rows[i / columns.size()]}, {column_number, columns[i % columns.size()]},
                         grid);
        grid.files.push_back(file->path);
    }
    if (const std::size_t i = indexed.size(); i < rows.size() * columns.size())
        fail_missing(group, {row_number, rows[i / columns.size()]}, {column_number, columns[i % columns.size()]}, grid);
    return grid;
}

PictureGrid counted(const NumberedFiles& group, std::size_t number, std::size_t columns, std::size_t rows) {
    std::vector<NumberedFile> files = group.files;
    std::ranges::sort(files, {}, [&](const NumberedFile& file) { return file.numbers[number]; });
    for (std::size_t i = 1; i < files.size(); ++i) {
        const std::int64_t before = files[i - 1].numbers[number], now = files[i].numbers[number];
        if (now == before)
            throw Error(ErrorCode::bad_input, fmt::format("{}: is the same view as {}", files[i].path.string(),
                                                          files[i - 1].path.filename().string()));
        if (now != before + 1)
            throw Error(
                ErrorCode::bad_input,
                fmt::format("{}: a view is missing; the next one is {}",
                            (files[i - 1].path.parent_path() /
                             name_with(files[i - 1].path.stem().string(), number, before + 1, number, before + 1))
                                    .string() +
                                files[i - 1].path.extension().string(),
                            files[i].path.filename().string()));
    }
    const std::size_t count = files.size();
    const std::string folder = files.front().path.parent_path().string(),
                      pictures = fmt::format("{} pictures such as {}", count, files.front().path.filename().string());
    if (columns == 0) {
        columns = rows = static_cast<std::size_t>(std::llround(std::sqrt(static_cast<double>(count))));
        if (columns * rows != count)
            throw Error(ErrorCode::usage, "views",
                        fmt::format("{}: {} are not as many rows as columns; the number of columns "
                                    "and rows of views is needed",
                                    folder, pictures));
    }
    if (columns * rows != count)
        throw Error(ErrorCode::usage, "views",
                    fmt::format("{}: {}x{} views were asked for, but there are {}", folder, columns, rows, pictures));
    PictureGrid grid{rows, columns, {}};
    for (NumberedFile& file : files) grid.files.push_back(std::move(file.path));
    return grid;
}

}  // namespace hogel::exchange

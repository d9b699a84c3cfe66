// SPDX-License-Identifier: Apache-2.0
// Protocol of the child: for each array 'a', its head and its name. If its elements are wanted, blocks of rows follow,
// each after 'b' and its size. 'e' ends the list. 'n' and a reason report an error at any point.
#include "hogel/io/mat73_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "hogel/core/child_process.h"
#include "hogel/error.h"
#include "hogel/io/hdf5/dataset.h"
#include "hogel/io/hdf5/runs.h"

namespace hogel::io {
namespace {

using core::ChildProcess;
using hdf5::Handle;

// As in rehearsal.cpp and sample_server.cpp.
constexpr std::uint64_t spare_memory = std::uint64_t{1} << 29;
constexpr unsigned spare_seconds = 20;
constexpr std::uint64_t bytes_a_second = std::uint64_t{1} << 20, copies_of_chunk = 4;

constexpr std::uint64_t block_bytes = std::uint64_t{4} << 20;  // for rows without chunks
constexpr std::size_t max_reason = 1000, max_name = 65536, max_axes = 32;
constexpr std::uint64_t max_expansion = 1040;  // deflate expands at most 1032-fold

using WantsElements = std::function<bool(const Mat73Array&)>;

struct ArrayHead {
    std::size_t name_bytes = 0, axes = 0, numbers = 0;
    std::array<Number, 2> number{};
    std::array<std::uint64_t, max_axes> shape{};
};

std::optional<Number> number_of(hid_t type) {
    const std::pair<hid_t, Number> known[] = {{H5T_IEEE_F64LE, Number::real},  {H5T_IEEE_F32LE, Number::single},
                                              {H5T_STD_U8LE, Number::uint8},   {H5T_STD_I8LE, Number::int8},
                                              {H5T_STD_U16LE, Number::uint16}, {H5T_STD_I16LE, Number::int16},
                                              {H5T_STD_U32LE, Number::uint32}, {H5T_STD_I32LE, Number::int32},
                                              {H5T_STD_U64LE, Number::uint64}, {H5T_STD_I64LE, Number::int64}};
    for (const auto& [same, number] : known)
        if (H5Tequal(type, same) > 0) return number;
    return {};
}

// Returns the types of an element: one number or a compound {real, imag}; none for others.
std::vector<Number> numbers_of_element(hid_t type) {
    if (const auto number = number_of(type)) return {*number};
    if (H5Tget_class(type) != H5T_COMPOUND || H5Tget_nmembers(type) != 2) return {};
    std::vector<Number> numbers;
    for (int member = 0; member < 2; ++member) {
        if (H5Tget_member_index(type, member == 0 ? "real" : "imag") != member) return {};
        const Handle part(H5Tget_member_type(type, static_cast<unsigned>(member)), H5Tclose);
        const auto number = number_of(part.id());
        if (!number) return {};
        numbers.push_back(*number);
    }
    return numbers;
}

std::vector<std::size_t> shape_of(hid_t dataset) {
    const Handle space(H5Dget_space(dataset), H5Sclose);
    std::array<hsize_t, H5S_MAX_RANK> shape{};
    const int axes = H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
    return {shape.begin(), shape.begin() + std::max(axes, 0)};
}

Mat73Array array_of(const ArrayHead& head, const std::string& name) {
    Mat73Array array;
    array.name = name;
    array.shape.assign(head.shape.begin(), head.shape.begin() + head.axes);
    array.numbers.assign(head.number.begin(), head.number.begin() + head.numbers);
    return array;
}

void require_room(const std::filesystem::path& path, const Mat73Array& array) {
    if (array.samples() / max_expansion > std::filesystem::file_size(path) / array.element_bytes())
        hdf5::fail(path, fmt::format("its array '{}' has more samples than the file can hold", array.name));
}

// Child side of the protocol.
class ArraySender {
  public:
    ArraySender(const std::filesystem::path& path, int pipe)
        : path_(path), pipe_(pipe), file_(hdf5::open_unchecked_file(path)) {}

    void send_all(const WantsElements& wants_elements) const {
        for (const std::string& name : names()) {
            const Handle object(H5Oopen(file_.id(), name.c_str(), H5P_DEFAULT), H5Oclose);
            if (!object.valid()) fail(name, "is damaged: " + hdf5::reason());
            if (H5Iget_type(object.id()) != H5I_DATASET) continue;
            const std::optional<ArrayHead> head = head_of(object.id(), name);
            if (!head) continue;
            ChildProcess::write(pipe_, "a", 1);
            ChildProcess::write(pipe_, &*head, sizeof *head);
            ChildProcess::write(pipe_, name.data(), name.size());
            const Mat73Array array = array_of(*head, name);
            if (!wants_elements(array)) continue;
            require_room(path_, array);
            send_elements(object.id(), name);
        }
        ChildProcess::write(pipe_, "e", 1);
    }

  private:
    [[noreturn]] void fail(const std::string& name, const std::string& why) const {
        hdf5::fail(path_, fmt::format("its array '{}' {}", name, why));
    }

    // Returns the names of hard links.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        const auto take = [](hid_t, const char* name, const H5L_info_t* link, void* to) -> herr_t {
            if (link->type == H5L_TYPE_HARD) static_cast<std::vector<std::string>*>(to)->emplace_back(name);
            return 0;
        };
        if (H5Literate(file_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names) < 0)
            hdf5::fail(path_, "its group of arrays is damaged: " + hdf5::reason());
        return names;
    }

    // Texts, logical arrays and cells are also stored as integers.
    bool is_numeric(hid_t dataset) const {
        static constexpr const char* classes[] = {"double", "single", "int8",   "uint8", "int16",
                                                  "uint16", "int32",  "uint32", "int64", "uint64"};
        if (!hdf5::has_attribute(dataset, "MATLAB_class", path_)) return true;
        return std::ranges::find(classes, hdf5::read_text(dataset, "MATLAB_class", path_)) != std::end(classes);
    }

    std::optional<ArrayHead> head_of(hid_t dataset, const std::string& name) const {
        const Handle type(H5Dget_type(dataset), H5Tclose);
        if (!type.valid()) fail(name, "is damaged: " + hdf5::reason());
        const std::vector<Number> numbers = numbers_of_element(type.id());
        const std::vector<std::size_t> shape = shape_of(dataset);
        if (numbers.empty() || shape.size() < 2 || std::ranges::count(shape, 0u) != 0 || !is_numeric(dataset))
            return {};
        ArrayHead head{.name_bytes = name.size(), .axes = shape.size(), .numbers = numbers.size()};
        std::ranges::copy(numbers, head.number.begin());
        std::ranges::copy(shape, head.shape.begin());
        return head;
    }

    void send_elements(hid_t dataset, const std::string& name) const {
        const auto refuse = [&](const std::string& why) { fail(name, why); };
        const std::vector<std::size_t> shape = shape_of(dataset);
        const hdf5::Storage storage = hdf5::storage_of(dataset, shape, refuse);
        require_chunks(dataset, name, shape, storage.chunk);
        const Handle type(H5Tcopy(dataset), H5Tclose);
        H5Tpack(type.id());
        const std::uint64_t row_bytes = H5Tget_size(type.id()) * hdf5::samples_of({shape.begin() + 1, shape.end()});
        const std::size_t rows = storage.chunk.empty() ? 1 + block_bytes / row_bytes : storage.chunk[0];
        std::vector<hsize_t> start(shape.size()), extent(shape.begin(), shape.end());
        for (; start[0] < shape[0]; start[0] += rows) {
            extent[0] = std::min<hsize_t>(rows, shape[0] - start[0]);
            const std::uint64_t bytes = extent[0] * row_bytes, needed = bytes + copies_of_chunk * storage.chunk_bytes;
            ChildProcess::renew_limits({.memory = spare_memory + needed,
                                        .cpu_seconds = spare_seconds + static_cast<unsigned>(needed / bytes_a_second)});
            send_block(dataset, name, type.id(), start, extent, std::vector<unsigned char>(bytes));
        }
    }

    // Throws if a chunk was never written; HDF5 would read it as zeros.
    void require_chunks(hid_t dataset, const std::string& name, const std::vector<std::size_t>& shape,
                        const std::vector<std::size_t>& chunk) const {
        if (chunk.empty()) return;
        std::size_t expected = 1;
        for (std::size_t axis = 0; axis < shape.size(); ++axis)
            expected *= (shape[axis] + chunk[axis] - 1) / chunk[axis];
        const Handle space(H5Dget_space(dataset), H5Sclose);
        hsize_t written = 0;
        if (H5Dget_num_chunks(dataset, space.id(), &written) < 0) fail(name, "is damaged: " + hdf5::reason());
        if (written != expected) fail(name, "is not wholly written");
    }

    void send_block(hid_t dataset, const std::string& name, hid_t type, const std::vector<hsize_t>& start,
                    const std::vector<hsize_t>& extent, std::vector<unsigned char> block) const {
        const Handle file_space(H5Dget_space(dataset), H5Sclose);
        const Handle memory_space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
        if (H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) < 0 ||
            H5Dread(dataset, type, memory_space.id(), file_space.id(), H5P_DEFAULT, block.data()) < 0)
            fail(name, "cannot be read: " + hdf5::reason());
        const std::uint64_t bytes = block.size();
        ChildProcess::write(pipe_, "b", 1);
        ChildProcess::write(pipe_, &bytes, sizeof bytes);
        ChildProcess::write(pipe_, block.data(), bytes);
    }

    std::filesystem::path path_;
    int pipe_;
    Handle file_;
};

void serve(const std::filesystem::path& path, const WantsElements& wants_elements, int pipe) {
    std::string reason;
    try {
        return ArraySender(path, pipe).send_all(wants_elements);
    } catch (const Error& error) {
        reason = error.what();
    }
    reason.resize(max_reason - 1);
    ChildProcess::write(pipe, "n", 1);
    ChildProcess::write(pipe, reason.c_str(), max_reason);
}

// Parent side, which validates everything, because the child may be compromised by a damaged file.
class ArrayReceiver {
  public:
    ArrayReceiver(ChildProcess& child, const std::filesystem::path& path) : child_(child), path_(path) {}

    std::vector<Mat73Array> take_all(const WantsElements& wants_elements) const {
        std::vector<Mat73Array> arrays;
        while (next("ae") == 'a') {
            Mat73Array& array = arrays.emplace_back(take_head());
            if (!wants_elements(array)) continue;
            require_room(path_, array);
            take_elements(array);
        }
        return arrays;
    }

  private:
    template <class T>
    T take() const {
        T value{};
        child_.read(&value, sizeof value);
        return value;
    }

    char next(std::string_view expected) const {
        const char kind = take<char>();
        if (kind == 'n') throw Error(ErrorCode::bad_input, take<std::array<char, max_reason>>().data());
        require(expected.find(kind) != expected.npos);
        return kind;
    }

    void require(bool good) const {
        if (!good) hdf5::fail(path_, "it is damaged: the HDF5 library misunderstands it");
    }

    Mat73Array take_head() const {
        const auto head = take<ArrayHead>();
        require(head.name_bytes <= max_name && head.axes >= 2 && head.axes <= max_axes && head.numbers >= 1 &&
                head.numbers <= 2);
        std::string name(head.name_bytes, '\0');
        child_.read(name.data(), name.size());
        Mat73Array array = array_of(head, name);
        require(std::ranges::count(array.shape, 0u) == 0 && std::ranges::max(array.numbers) <= Number::real);
        return array;
    }

    void take_elements(Mat73Array& array) const {
        const std::uint64_t total = array.samples() * array.element_bytes();
        while (array.elements.size() < total) {
            next("b");
            const std::uint64_t filled = array.elements.size(), bytes = take<std::uint64_t>();
            require(bytes > 0 && bytes <= total - filled);
            if (filled == 0) array.elements.reserve(total);
            array.elements.resize(filled + bytes);
            child_.read(&array.elements[filled], bytes);
        }
    }

    ChildProcess& child_;
    const std::filesystem::path& path_;
};

}  // namespace

std::vector<Mat73Array> read_mat73_arrays(const std::filesystem::path& path,
                                          const std::function<bool(const Mat73Array&)>& wants_elements) {
    const hdf5::Session session;  // no other thread is inside HDF5 during the fork
    try {
        return core::with_child(
            {.memory = spare_memory, .cpu_seconds = spare_seconds},
            [&](int pipe) { serve(path, wants_elements, pipe); },
            [&](ChildProcess& child) { return ArrayReceiver(child, path).take_all(wants_elements); });
    } catch (const core::ChildFailure& failure) {
        hdf5::fail(path, fmt::format("the HDF5 library {} on it", failure.what()));
    }
}

}  // namespace hogel::io

// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/distributed/shared_plane.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "hogel/error.h"

namespace hogel::optics::distributed {
namespace {

using Complex = std::complex<float>;

// Samples of a message between processes, and the messages that are sent before one is waited for: few, so that what is
// under way takes little memory.
constexpr std::size_t max_message = (std::size_t{1} << 20) / sizeof(Complex), messages_ahead = 4;

std::size_t messages_of(std::size_t items, std::size_t items_in_one) {
    return (items + items_in_one - 1) / items_in_one;
}

// Sends another process as many messages as it sends to this one; few are under way. Message i is taken after all
// before it, and itself, have been packed.
template <class Pack, class Take>
void swap_messages(Communicator& communicator, std::size_t other, std::size_t count, const Pack& pack,
                   const Take& take) {
    for (std::size_t sent = 0, taken = 0; taken < count; ++taken) {
        for (; sent < std::min(count, taken + messages_ahead); ++sent) communicator.send_to(other, pack(sent));
        take(taken, communicator.receive_from(other));
    }
}

void require_size(const std::string& bytes, std::size_t samples) {
    if (bytes.size() != samples * sizeof(Complex))
        throw Error(ErrorCode::internal, "a message from another process has another size than expected");
}

// The process that a process swaps with in a step, of as many as there are: itself in one of them.
std::size_t partner(const Communicator& communicator, std::size_t step) {
    return (step + communicator.size() - communicator.rank()) % communicator.size();
}

}  // namespace

LineRange common_lines(const LineRange& a, const LineRange& b) {
    const std::size_t first = std::max(a.first, b.first), end = std::min(a.end(), b.end());
    return {first, std::max(first, end) - first};
}

LineRange lines_of(std::size_t process, std::size_t processes, std::size_t lines, std::size_t together) {
    const std::size_t groups = (lines + together - 1) / together;
    const auto begin = [&](std::size_t i) { return std::min(lines, i * groups / processes * together); };
    return {begin(process), begin(process + 1) - begin(process)};
}

SharedPlane::SharedPlane(std::size_t rows, std::size_t columns, std::size_t block_rows, std::size_t block_columns,
                         const ScratchOptions& scratch, Communicator* communicator)
    : rows_(rows), columns_(columns), block_rows_(block_rows), block_columns_(block_columns) {
    if (communicator != nullptr && communicator->size() > 1) {
        communicator_ = communicator;
        rank_ = communicator->rank();
        size_ = communicator->size();
    }
    // For any number of rows up to this one.
    const std::size_t groups = (rows + block_rows - 1) / block_rows;
    const std::size_t max_rows = std::min(rows, (groups + size_ - 1) / size_ * block_rows);
    std::size_t samples = 0;
    for (std::size_t process = 0; process < size_; ++process) {
        block_starts_.push_back(samples);
        samples += max_rows * std::max(lines_of(process, size_, columns, block_columns).count, local_columns().count);
    }
    samples_ = size_ == 1 ? core::PagedArray({rows, columns}, scratch, core::Contents::unset)
                          : core::PagedArray({1, std::max<std::size_t>(samples, 1)}, scratch, core::Contents::unset);
    begin_columns(rows);
}

void SharedPlane::begin_columns(std::size_t rows) {
    rows_ = rows;
    places_ = in_columns(rows);
}

LocalColumns SharedPlane::in_columns(std::size_t rows) {
    const LineRange across = local_columns();
    std::vector<Complex*> starts;
    starts.reserve(rows);
    for (std::size_t process = 0; process < size_; ++process) {
        const std::size_t count = lines_of(process, size_, rows, block_rows_).count;
        for (std::size_t y = 0; y < count; ++y)
            starts.push_back(samples_.view().data() + block_starts_[process] + y * across.count);
    }
    return {std::move(starts), across.first};
}

void SharedPlane::put_row(std::size_t y, const Complex* from) {
    const std::size_t own = y - local_rows(rows_).first;
    for (std::size_t process = 0; process < size_; ++process) {
        const LineRange columns = lines_of(process, size_, columns_, block_columns_);
        std::copy_n(from + columns.first, columns.count,
                    samples_.view().data() + block_starts_[process] + own * columns.count);
    }
}

void SharedPlane::get_row(std::size_t y, Complex* to) const {
    const std::size_t own = y - local_rows(rows_).first;
    for (std::size_t process = 0; process < size_; ++process) {
        const LineRange columns = lines_of(process, size_, columns_, block_columns_);
        std::copy_n(samples_.view().data() + block_starts_[process] + own * columns.count, columns.count,
                    to + columns.first);
    }
}

void SharedPlane::to_columns(std::size_t rows) {
    rows_ = rows;
    transpose(false);
    begin_columns(rows);
}

void SharedPlane::to_rows(std::size_t rows) {
    rows_ = rows;
    transpose(true);
}

// Samples of the block for another process.
std::size_t SharedPlane::block_size(std::size_t process, bool columns) const {
    return columns ? lines_of(process, size_, rows_, block_rows_).count * local_columns().count
                   : local_rows(rows_).count * lines_of(process, size_, columns_, block_columns_).count;
}

// Each two processes swap the blocks that they have for each other. What comes takes the place of what was sent before.
void SharedPlane::transpose(bool columns) {
    for (std::size_t step = 0; step < size_; ++step) {
        const std::size_t other = communicator_ != nullptr ? partner(*communicator_, step) : 0;
        if (other == rank_) continue;
        Complex* const block = samples_.view().data() + block_starts_[other];
        const std::size_t to_send = block_size(other, columns), to_get = block_size(other, !columns);
        const auto part = [](std::size_t message, std::size_t samples) {
            const std::size_t first = std::min(samples, message * max_message);
            return LineRange{first, std::min(max_message, samples - first)};
        };
        swap_messages(
            *communicator_, other, messages_of(std::max(to_send, to_get), max_message),
            [&](std::size_t i) {
                const LineRange sent = part(i, to_send);
                return std::string(reinterpret_cast<const char*>(block + sent.first), sent.count * sizeof(Complex));
            },
            [&](std::size_t i, const std::string& bytes) {
                const LineRange got = part(i, to_get);
                require_size(bytes, got.count);
                std::memcpy(static_cast<void*>(block + got.first), bytes.data(), bytes.size());
            });
    }
}

void send_rows(Communicator& communicator, const Shape<2>& shape, std::size_t block_rows,
               const std::function<LineRange(std::size_t)>& wanted,
               const std::function<void(std::size_t, Complex*)>& get_row,
               const std::function<Complex*(std::size_t)>& place) {
    const std::size_t columns = shape[1], at_once = std::max<std::size_t>(1, max_message / columns);
    const auto rows_from_to = [&](std::size_t from, std::size_t to) {
        return common_lines(lines_of(from, communicator.size(), shape[0], block_rows), wanted(to));
    };
    for (std::size_t step = 0; step < communicator.size(); ++step) {
        const std::size_t other = partner(communicator, step);
        const LineRange sent = rows_from_to(communicator.rank(), other), got = rows_from_to(other, communicator.rank());
        if (other == communicator.rank()) {
            for (std::size_t y = sent.first; y < sent.end(); ++y) get_row(y, place(y));
            continue;
        }
        const auto part = [&](std::size_t message, const LineRange& rows) {
            return common_lines({rows.first + message * at_once, at_once}, rows);
        };
        swap_messages(
            communicator, other, messages_of(std::max(sent.count, got.count), at_once),
            [&](std::size_t i) {
                const LineRange rows = part(i, sent);
                std::string bytes(rows.count * columns * sizeof(Complex), '\0');
                for (std::size_t y = 0; y < rows.count; ++y)
                    get_row(rows.first + y, reinterpret_cast<Complex*>(bytes.data()) + y * columns);
                return bytes;
            },
            [&](std::size_t i, const std::string& bytes) {
                const LineRange rows = part(i, got);
                require_size(bytes, rows.count * columns);
                for (std::size_t y = 0; y < rows.count; ++y)
                    std::memcpy(static_cast<void*>(place(rows.first + y)), bytes.data() + y * columns * sizeof(Complex),
                                columns * sizeof(Complex));
            });
    }
}

std::vector<std::string> all_of(Communicator& communicator, const std::string& own) {
    for (std::size_t other = 0; other < communicator.size(); ++other)
        if (other != communicator.rank()) communicator.send_to(other, own);
    std::vector<std::string> all;
    for (std::size_t other = 0; other < communicator.size(); ++other)
        all.push_back(other == communicator.rank() ? own : communicator.receive_from(other));
    return all;
}

}  // namespace hogel::optics::distributed

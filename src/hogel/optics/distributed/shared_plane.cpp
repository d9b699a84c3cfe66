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

// Size of a message between ranks in samples, and the number of messages in flight: few, to save memory.
constexpr std::size_t max_message = (std::size_t{1} << 20) / sizeof(Complex), messages_ahead = 4;

std::size_t messages_of(std::size_t items, std::size_t items_per_message) {
    return (items + items_per_message - 1) / items_per_message;
}

// Exchanges `count` messages in each direction with a peer, with few in flight. Calls take(i) after pack(0) … pack(i).
template <class Pack, class Take>
void swap_messages(Communicator& communicator, std::size_t peer, std::size_t count, const Pack& pack,
                   const Take& take) {
    for (std::size_t packed = 0, taken = 0; taken < count; ++taken) {
        for (; packed < std::min(count, taken + messages_ahead); ++packed) communicator.send_to(peer, pack(packed));
        take(taken, communicator.receive_from(peer));
    }
}

void require_size(const std::string& bytes, std::size_t samples) {
    if (bytes.size() != samples * sizeof(Complex))
        throw Error(ErrorCode::internal, "a message from another rank has an unexpected length");
}

// Returns the peer of this rank in a step. In one of communicator.size() steps it is this rank itself.
std::size_t partner(const Communicator& communicator, std::size_t step) {
    return (step + communicator.size() - communicator.rank()) % communicator.size();
}

}  // namespace

LineRange common_lines(const LineRange& a, const LineRange& b) {
    const std::size_t first = std::max(a.first, b.first), end = std::min(a.end(), b.end());
    return {first, std::max(first, end) - first};
}

LineRange lines_of(std::size_t rank, std::size_t ranks, std::size_t lines, std::size_t group) {
    const std::size_t groups = (lines + group - 1) / group;
    const auto begin = [&](std::size_t i) { return std::min(lines, i * groups / ranks * group); };
    return {begin(rank), begin(rank + 1) - begin(rank)};
}

SharedPlane::SharedPlane(std::size_t rows, std::size_t columns, std::size_t block_rows, std::size_t block_columns,
                         const ScratchOptions& scratch, Communicator* communicator)
    : rows_(rows), columns_(columns), block_rows_(block_rows), block_columns_(block_columns) {
    if (communicator != nullptr && communicator->size() > 1) {
        communicator_ = communicator;
        rank_ = communicator->rank();
        size_ = communicator->size();
    }
    // Enough for any number of rows up to `rows`.
    const std::size_t groups = (rows + block_rows - 1) / block_rows;
    const std::size_t max_rows = std::min(rows, (groups + size_ - 1) / size_ * block_rows);
    std::size_t samples = 0;
    for (std::size_t rank = 0; rank < size_; ++rank) {
        block_starts_.push_back(samples);
        samples += max_rows * std::max(lines_of(rank, size_, columns, block_columns).count, local_columns().count);
    }
    samples_ = size_ == 1 ? core::PagedArray({rows, columns}, scratch, core::Contents::unset)
                          : core::PagedArray({1, std::max<std::size_t>(samples, 1)}, scratch, core::Contents::unset);
    begin_columns(rows);
}

void SharedPlane::begin_columns(std::size_t rows) {
    rows_ = rows;
    local_samples_ = in_columns(rows);
}

LocalColumns SharedPlane::in_columns(std::size_t rows) {
    const LineRange local = local_columns();
    std::vector<Complex*> row_addresses;
    row_addresses.reserve(rows);
    for (std::size_t rank = 0; rank < size_; ++rank) {
        const std::size_t count = lines_of(rank, size_, rows, block_rows_).count;
        for (std::size_t y = 0; y < count; ++y)
            row_addresses.push_back(samples_.view().data() + block_starts_[rank] + y * local.count);
    }
    return {std::move(row_addresses), local.first};
}

void SharedPlane::put_row(std::size_t y, const Complex* from) {
    const std::size_t local = y - local_rows(rows_).first;
    for (std::size_t rank = 0; rank < size_; ++rank) {
        const LineRange columns = lines_of(rank, size_, columns_, block_columns_);
        std::copy_n(from + columns.first, columns.count,
                    samples_.view().data() + block_starts_[rank] + local * columns.count);
    }
}

void SharedPlane::get_row(std::size_t y, Complex* to) const {
    const std::size_t local = y - local_rows(rows_).first;
    for (std::size_t rank = 0; rank < size_; ++rank) {
        const LineRange columns = lines_of(rank, size_, columns_, block_columns_);
        std::copy_n(samples_.view().data() + block_starts_[rank] + local * columns.count, columns.count,
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

// Returns the number of samples of the block for another rank.
std::size_t SharedPlane::block_size(std::size_t rank, bool columns) const {
    return columns ? lines_of(rank, size_, rows_, block_rows_).count * local_columns().count
                   : local_rows(rows_).count * lines_of(rank, size_, columns_, block_columns_).count;
}

// Each pair of ranks exchanges its blocks in place: received samples overwrite samples already sent.
void SharedPlane::transpose(bool columns) {
    for (std::size_t step = 0; step < size_; ++step) {
        const std::size_t peer = communicator_ != nullptr ? partner(*communicator_, step) : 0;
        if (peer == rank_) continue;
        Complex* const block = samples_.view().data() + block_starts_[peer];
        const std::size_t to_send = block_size(peer, columns), to_receive = block_size(peer, !columns);
        const auto chunk = [](std::size_t message, std::size_t samples) {
            const std::size_t first = std::min(samples, message * max_message);
            return LineRange{first, std::min(max_message, samples - first)};
        };
        swap_messages(
            *communicator_, peer, messages_of(std::max(to_send, to_receive), max_message),
            [&](std::size_t i) {
                const LineRange sent = chunk(i, to_send);
                return std::string(reinterpret_cast<const char*>(block + sent.first), sent.count * sizeof(Complex));
            },
            [&](std::size_t i, const std::string& bytes) {
                const LineRange received = chunk(i, to_receive);
                require_size(bytes, received.count);
                std::memcpy(static_cast<void*>(block + received.first), bytes.data(), bytes.size());
            });
    }
}

void send_rows(Communicator& communicator, const Shape<2>& shape, std::size_t block_rows,
               const std::function<LineRange(std::size_t)>& wanted,
               const std::function<void(std::size_t, Complex*)>& get_row,
               const std::function<Complex*(std::size_t)>& destination) {
    const std::size_t columns = shape[1], rows_per_message = std::max<std::size_t>(1, max_message / columns);
    const auto rows_from_to = [&](std::size_t from, std::size_t to) {
        return common_lines(lines_of(from, communicator.size(), shape[0], block_rows), wanted(to));
    };
    for (std::size_t step = 0; step < communicator.size(); ++step) {
        const std::size_t peer = partner(communicator, step);
        const LineRange sent = rows_from_to(communicator.rank(), peer),
                        received = rows_from_to(peer, communicator.rank());
        if (peer == communicator.rank()) {
            for (std::size_t y = sent.first; y < sent.end(); ++y) get_row(y, destination(y));
            continue;
        }
        const auto chunk = [&](std::size_t message, const LineRange& rows) {
            return common_lines({rows.first + message * rows_per_message, rows_per_message}, rows);
        };
        swap_messages(
            communicator, peer, messages_of(std::max(sent.count, received.count), rows_per_message),
            [&](std::size_t i) {
                const LineRange rows = chunk(i, sent);
                std::string bytes(rows.count * columns * sizeof(Complex), '\0');
                for (std::size_t y = 0; y < rows.count; ++y)
                    get_row(rows.first + y, reinterpret_cast<Complex*>(bytes.data()) + y * columns);
                return bytes;
            },
            [&](std::size_t i, const std::string& bytes) {
                const LineRange rows = chunk(i, received);
                require_size(bytes, rows.count * columns);
                for (std::size_t y = 0; y < rows.count; ++y)
                    std::memcpy(static_cast<void*>(destination(rows.first + y)),
                                bytes.data() + y * columns * sizeof(Complex), columns * sizeof(Complex));
            });
    }
}

std::vector<std::string> all_of(Communicator& communicator, const std::string& local) {
    for (std::size_t rank = 0; rank < communicator.size(); ++rank)
        if (rank != communicator.rank()) communicator.send_to(rank, local);
    std::vector<std::string> strings;
    for (std::size_t rank = 0; rank < communicator.size(); ++rank)
        strings.push_back(rank == communicator.rank() ? local : communicator.receive_from(rank));
    return strings;
}

}  // namespace hogel::optics::distributed

// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/transfer.h"

#include <algorithm>
#include <cmath>

#include "hogel/image.h"

namespace hogel {

const std::vector<std::string>& transfer_names() {
    static const std::vector<std::string> names{"srgb", "linear", "rec709", "gamma2.2"};
    return names;
}

std::optional<Transfer> transfer_named(const std::string& name) {
    if (name.empty()) return {};
    const auto found = std::ranges::find(transfer_names(), name);
    if (found == transfer_names().end()) throw_unknown("transfer", name, transfer_names(), "transfer");
    return static_cast<Transfer>(found - transfer_names().begin());
}

namespace exchange {

// ITU-R BT.709-6, 1.2: E' = α E^0.45 − (α − 1) for E >= β, otherwise 4.5 E; with BT.2020's α and β (continuous).
constexpr float alpha = 1.09929682680944f, beta = 0.018053968510807f;

float decode(Transfer transfer, float stored) {
    switch (transfer) {
        case Transfer::srgb:
            return srgb_decode(stored);
        case Transfer::rec709:
            return stored < 4.5f * beta ? stored / 4.5f : std::pow((stored + (alpha - 1)) / alpha, 1 / 0.45f);
        case Transfer::gamma22:
            return std::pow(std::max(stored, 0.0f), 2.2f);
        case Transfer::linear:
            break;
    }
    return stored;
}

float encode(Transfer transfer, float linear) {
    switch (transfer) {
        case Transfer::srgb:
            return srgb_encode(linear);
        case Transfer::rec709:
            return linear < beta ? 4.5f * linear : alpha * std::pow(linear, 0.45f) - (alpha - 1);
        case Transfer::gamma22:
            return std::pow(std::max(linear, 0.0f), 1 / 2.2f);
        case Transfer::linear:
            break;
    }
    return linear;
}

}  // namespace exchange
}  // namespace hogel

// SPDX-License-Identifier: Apache-2.0
#include "view/waves.h"

#include <algorithm>
#include <stop_token>
#include <utility>

#include "hogel/error.h"

namespace hogel::view {

Waves::Waves(Make make, std::size_t looks, std::size_t memory, Progress making)
    : make_(std::move(make)), looks_(looks), memory_(memory), making_(std::move(making)) {}

void Waves::photograph(const Camera& camera, std::size_t looks, bool preview, const Shown& shown,
                       const Progress& progress) {
    if (fields_.empty()) fields_ = make_();
    std::optional<EyePhotographer>& photographer = photographers_[preview ? 1 : 0];
    if (!photographer) {
        const BandCamera model{.memory = memory_, .preview = preview};
        if (const auto& other = photographers_[preview ? 0 : 1])
            photographer.emplace(*other, model);
        else
            photographer.emplace(fields_, model, making_);
    }
    const std::size_t wanted = looks == 0 ? looks_ : std::min(looks, looks_);
    // The photographer always takes all looks: stop it after the last one wanted.
    std::stop_source enough;
    const std::stop_callback forward(progress.stop(), [&enough] { enough.request_stop(); });
    bool complete = false;
    const auto count = [&](const Image& picture, std::size_t so_far) {
        if (complete) return;
        complete = so_far >= wanted;
        shown(picture, so_far);
        if (complete) enough.request_stop();
    };
    try {
        photographer->photograph(camera, count, Progress(enough.get_token()));
    } catch (const Error& error) {
        if (!complete || error.code() != ErrorCode::cancelled) throw;
    }
}

}  // namespace hogel::view

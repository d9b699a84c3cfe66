// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks what the library exports; everything else is hidden.
#define HOGEL_API __attribute__((visibility("default")))

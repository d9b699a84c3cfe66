// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Exports a symbol from the shared library; all other symbols are hidden.
#define HOGEL_API __attribute__((visibility("default")))

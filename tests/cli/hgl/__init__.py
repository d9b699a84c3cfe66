# SPDX-License-Identifier: Apache-2.0
"""A plain decoder of compressed light fields, written from docs/format.md: see decode_hgl.py."""

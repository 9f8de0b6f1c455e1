/* SPDX-License-Identifier: LGPL-3.0-or-later */

/* What jemalloc reads before main. Factors and matrices are large blocks that are made and freed many times.
   In pages of 4 KB their page faults and address translations cost a third of the time of a fine mesh's first
   steps; so memory is asked for in huge pages, and kept for the next block. MALLOC_CONF in the environment
   overrides it. */
const char* malloc_conf = "thp:always,narenas:1,oversize_threshold:0,dirty_decay_ms:-1,muzzy_decay_ms:-1";

// The OpenCL sources of this folder, embedded at build time by cmake/embed_files.cmake.
#pragma once

#include <span>
#include <string_view>

namespace smx {

struct KernelFile {
    std::string_view name;
    std::string_view text;
};

std::span<const KernelFile> kernel_files();

} // namespace smx

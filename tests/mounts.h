// Disks of the tests' own: small ones, and one that cannot be written. They are seen by this process and its children
// only, and go with it.
#pragma once

#include <cstddef>
#include <string>

namespace test {

// Whether this process may mount; needed once before the others. Only root may, and not in every container.
bool can_mount();

// A disk of `bytes` in this folder, for as long as it lives. All throw std::runtime_error.
class SmallDisk {
  public:
    SmallDisk(std::string folder, std::size_t bytes);
    SmallDisk(const SmallDisk &) = delete;
    SmallDisk &operator=(const SmallDisk &) = delete;
    ~SmallDisk();

    void resize(std::size_t bytes); // what is there stays
    void make_read_only();

  private:
    std::string folder_;
    std::size_t bytes_;
};

} // namespace test

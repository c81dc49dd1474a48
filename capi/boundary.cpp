#include "boundary.h"

#include <algorithm>

#include "opencl.h"

namespace smx {

namespace {

// A fixed buffer: telling of a failed allocation must not allocate.
thread_local char last_error[4096] = "";

struct StatusText {
    smx_status status;
    const char *name, *sentence;
};

constexpr StatusText statuses[] = {
    {SMX_OK, "SMX_OK", "success"},
    {SMX_INVALID_ARGUMENT, "SMX_INVALID_ARGUMENT", "an argument is null, of the wrong size or out of its range"},
    {SMX_CANNOT_READ, "SMX_CANNOT_READ", "a file is missing or unreadable"},
    {SMX_CANNOT_WRITE, "SMX_CANNOT_WRITE", "an output cannot be made"},
    {SMX_BAD_FORMAT, "SMX_BAD_FORMAT", "a file's content is not what its format demands"},
    {SMX_NO_DEVICE, "SMX_NO_DEVICE", "no OpenCL device, or none that matches"},
    {SMX_KERNEL_BUILD, "SMX_KERNEL_BUILD", "the device's compiler refused a kernel"},
    {SMX_DEVICE_ERROR, "SMX_DEVICE_ERROR", "an OpenCL call failed"},
    {SMX_OUT_OF_MEMORY, "SMX_OUT_OF_MEMORY", "out of host or device memory"},
    {SMX_NO_SOLUTION, "SMX_NO_SOLUTION", "the data have no answer"},
    {SMX_CANCELLED, "SMX_CANCELLED", "cancelled by the progress callback"},
    {SMX_INTERNAL, "SMX_INTERNAL", "a fault of the library itself"}};

static_assert(static_cast<int>(Fault::InvalidArgument) == SMX_INVALID_ARGUMENT);
static_assert(static_cast<int>(Fault::CannotRead) == SMX_CANNOT_READ);
static_assert(static_cast<int>(Fault::CannotWrite) == SMX_CANNOT_WRITE);
static_assert(static_cast<int>(Fault::BadFormat) == SMX_BAD_FORMAT);
static_assert(static_cast<int>(Fault::NoDevice) == SMX_NO_DEVICE);
static_assert(static_cast<int>(Fault::KernelBuild) == SMX_KERNEL_BUILD);
static_assert(static_cast<int>(Fault::DeviceError) == SMX_DEVICE_ERROR);
static_assert(static_cast<int>(Fault::OutOfMemory) == SMX_OUT_OF_MEMORY);
static_assert(static_cast<int>(Fault::NoSolution) == SMX_NO_SOLUTION);
static_assert(static_cast<int>(Fault::Cancelled) == SMX_CANCELLED);
static_assert(static_cast<int>(Fault::Internal) == SMX_INTERNAL);

const StatusText *find_status(smx_status status) noexcept {
    const auto *found =
        std::find_if(std::begin(statuses), std::end(statuses), [&](const StatusText &s) { return s.status == status; });
    return found == std::end(statuses) ? nullptr : found;
}

} // namespace

void set_last_error(const char *message) noexcept {
    std::strncpy(last_error, message, sizeof last_error - 1);
    last_error[sizeof last_error - 1] = '\0';
}

smx_status translate_exception() noexcept {
    try {
        try {
            throw;
        } catch (const cl::Error &e) {
            fail_opencl(e);
        }
    } catch (const Error &e) {
        set_last_error(e.what());
        return static_cast<smx_status>(e.fault());
    } catch (const std::bad_alloc &) {
        set_last_error("out of host memory");
        return SMX_OUT_OF_MEMORY;
    } catch (const std::exception &e) {
        set_last_error(e.what());
        return SMX_INTERNAL;
    } catch (...) {
        set_last_error("an exception of unknown kind");
        return SMX_INTERNAL;
    }
}

} // namespace smx

extern "C" {

const char *smx_status_name(smx_status status) {
    const auto *found = smx::find_status(status);
    return found ? found->name : "unknown status";
}

const char *smx_status_text(smx_status status) {
    const auto *found = smx::find_status(status);
    return found ? found->sentence : "unknown status";
}

const char *smx_last_error(void) { return smx::last_error; }

const char *smx_version(void) { return SMX_VERSION_STRING; }
}

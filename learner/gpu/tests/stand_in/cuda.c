// A driver for tests on machines without a GPU: the functions of libcuda that the program uses. Kernels are those of
// kernels.cu, compiled as C; each launch runs all threads in turn, and a graph is the list of its launches.
//
// Compiled with -I the folder of kernels.cu, as a library whose SONAME is libcuda.so. Environment:
//   STAND_IN_VERSION     newest CUDA that the driver supports, as it counts (default 12040)
//   STAND_IN_GPUS        number of GPUs (default 1)
//   STAND_IN_BYTES       memory of the GPU (default 8 GB)
//   STAND_IN_LAUNCHES    graphs that run before the driver fails (default: it never does)
//   STAND_IN_WRONG       1: products are left out

#define _GNU_SOURCE
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static __thread struct { unsigned x, y, z; } blockIdx, threadIdx, blockDim;

#define KERNEL void
#define INLINE static inline
#include "kernels.cu"

enum { SUCCESS = 0, INVALID_VALUE = 1, OUT_OF_MEMORY = 2, NO_DEVICE = 100, NOT_FOUND = 500, LAUNCH_FAILED = 719 };
typedef int Result;
typedef void (*Kernel)(float *, u32 *, double *, u32);
typedef struct { Kernel kernel; unsigned grid[3], block; void *arrays[3]; u32 at; } Launch;
typedef struct { Launch *launches; size_t count; } Graph;
typedef struct { Graph *captured; } Stream;

static size_t used;
static long launches;

static long number(const char *name, long otherwise) {
    const char *text = getenv(name);
    return text ? atol(text) : otherwise;
}

static size_t bytes(void) { return number("STAND_IN_BYTES", 8000000000L); }

static Result run(const Launch *launch) {
    // A GPU that computes something else.
    if (launch->kernel == product && number("STAND_IN_WRONG", 0))
        return SUCCESS;
    blockDim.x = launch->block;
    for (blockIdx.z = 0; blockIdx.z < launch->grid[2]; blockIdx.z++)
        for (blockIdx.y = 0; blockIdx.y < launch->grid[1]; blockIdx.y++)
            for (blockIdx.x = 0; blockIdx.x < launch->grid[0]; blockIdx.x++)
                for (threadIdx.x = 0; threadIdx.x < launch->block; threadIdx.x++)
                    launch->kernel(launch->arrays[0], launch->arrays[1], launch->arrays[2], launch->at);
    return SUCCESS;
}

// The driver and its GPU.
Result cuInit(unsigned flags) { return number("STAND_IN_GPUS", 1) ? SUCCESS : NO_DEVICE; }
Result cuDriverGetVersion(int *version) { *version = number("STAND_IN_VERSION", 12040); return SUCCESS; }
Result cuDeviceGet(int *device, int ordinal) { *device = ordinal; return SUCCESS; }
// As real drivers, it has pools of memory.
enum { MEMORY_POOLS_SUPPORTED = 115 };
Result cuDeviceGetAttribute(int *value, int attribute, int device) { *value = attribute == MEMORY_POOLS_SUPPORTED; return SUCCESS; }
Result cuDeviceGetName(char *name, int length, int device) { snprintf(name, length, "Stand-in"); return SUCCESS; }
Result cuDevicePrimaryCtxRetain(void **context, int device) { *context = &used; return SUCCESS; }
Result cuDevicePrimaryCtxRelease_v2(int device) { return SUCCESS; }
Result cuCtxSetCurrent(void *context) { return SUCCESS; }
Result cuCtxGetCurrent(void **context) { *context = &used; return SUCCESS; }
Result cuCtxSynchronize(void) { return SUCCESS; }
Result cuMemGetInfo_v2(size_t *free, size_t *all) { *all = bytes(); *free = *all - used; return SUCCESS; }

Result cuGetErrorName(Result error, const char **text) {
    *text = error == NO_DEVICE ? "CUDA_ERROR_NO_DEVICE" : error == LAUNCH_FAILED ? "CUDA_ERROR_LAUNCH_FAILED" : "CUDA_ERROR_UNKNOWN";
    return SUCCESS;
}
Result cuGetErrorString(Result error, const char **text) {
    *text = error == NO_DEVICE ? "no CUDA-capable device is detected" : "unspecified launch failure";
    return SUCCESS;
}

// Memory; each allocation begins with its size.
Result cuMemAlloc_v2(void **address, size_t size) {
    if (used + size > bytes())
        return OUT_OF_MEMORY;
    size_t *memory = calloc(1, size + 64);
    *memory = size;
    used += size;
    *address = (char *)memory + 64;
    return SUCCESS;
}
Result cuMemFree_v2(void *address) {
    size_t *memory = (size_t *)((char *)address - 64);
    used -= *memory;
    free(memory);
    return SUCCESS;
}
Result cuMemAllocAsync(void **address, size_t size, Stream *stream) { return cuMemAlloc_v2(address, size); }
Result cuMemFreeAsync(void *address, Stream *stream) { return cuMemFree_v2(address); }
Result cuMemcpyHtoDAsync_v2(void *to, const void *from, size_t size, Stream *stream) { memcpy(to, from, size); return SUCCESS; }
Result cuMemcpyDtoHAsync_v2(void *to, const void *from, size_t size, Stream *stream) { memcpy(to, from, size); return SUCCESS; }
Result cuMemcpyDtoDAsync_v2(void *to, const void *from, size_t size, Stream *stream) { memcpy(to, from, size); return SUCCESS; }
Result cuMemsetD8Async(void *to, unsigned char byte, size_t size, Stream *stream) { memset(to, byte, size); return SUCCESS; }

// Kernels: this library's own functions; the text that is loaded must name them.
static char *module_text;
Result cuModuleLoadData(void **module, const void *image) {
    module_text = strdup(image);
    *module = &module_text;
    return strstr(image, ".target sm_") ? SUCCESS : INVALID_VALUE;
}
Result cuModuleUnload(void *module) { return SUCCESS; }
#define NAMED(kernel) {#kernel, kernel}
static const struct { const char *name; Kernel kernel; } KERNELS[] = {
    NAMED(gather), NAMED(transpose), NAMED(product), NAMED(activate), NAMED(activate_backward), NAMED(loss), NAMED(column_sums),
    NAMED(sum_slices), NAMED(sum_terms), NAMED(sum_sums), NAMED(prepare_step), NAMED(adam), NAMED(divergence),
};
Result cuModuleGetFunction(Kernel *kernel, void *module, const char *name) {
    char entry[64];
    snprintf(entry, sizeof entry, ".visible .entry %s(", name);
    for (size_t i = 0; i < sizeof KERNELS / sizeof *KERNELS; i++) {
        *kernel = KERNELS[i].kernel;
        if (!strcmp(KERNELS[i].name, name))
            return strstr(module_text, entry) ? SUCCESS : NOT_FOUND;
    }
    return NOT_FOUND;
}
Result cuFuncGetAttribute(int *value, int attribute, Kernel kernel) { *value = 32; return SUCCESS; }
Result cuLaunchKernel(Kernel kernel, unsigned x, unsigned y, unsigned z, unsigned block, unsigned block_y, unsigned block_z,
                      unsigned shared, Stream *stream, void **arguments, void **extra) {
    Launch launch = {kernel, {x, y, z}, block, {0}, *(u32 *)arguments[3]};
    if (!x || !y || !z || y > 65535 || z > 65535 || !block || block > 1024 || block_y != 1 || block_z != 1)
        return INVALID_VALUE;
    for (int i = 0; i < 3; i++)
        launch.arrays[i] = *(void **)arguments[i];
    Graph *graph = stream->captured;
    if (!graph)
        return run(&launch);
    graph->launches = realloc(graph->launches, (graph->count + 1) * sizeof launch);
    graph->launches[graph->count++] = launch;
    return SUCCESS;
}

// Streams and graphs.
Result cuStreamCreate(Stream **stream, unsigned flags) { *stream = calloc(1, sizeof **stream); return SUCCESS; }
Result cuStreamDestroy_v2(Stream *stream) { free(stream); return SUCCESS; }
Result cuStreamSynchronize(Stream *stream) { return SUCCESS; }
Result cuStreamBeginCapture_v2(Stream *stream, int mode) { stream->captured = calloc(1, sizeof(Graph)); return SUCCESS; }
Result cuStreamEndCapture(Stream *stream, Graph **graph) { *graph = stream->captured; stream->captured = 0; return SUCCESS; }
Result cuGraphInstantiateWithFlags(Graph **exec, Graph *graph, unsigned long long flags) { *exec = graph; return SUCCESS; }
Result cuGraphExecDestroy(Graph *exec) { return SUCCESS; }
Result cuGraphDestroy(Graph *graph) { free(graph->launches); free(graph); return SUCCESS; }
Result cuGraphLaunch(Graph *exec, Stream *stream) {
    long most = number("STAND_IN_LAUNCHES", -1);
    if (most >= 0 && launches++ >= most)
        return LAUNCH_FAILED;
    for (size_t i = 0; i < exec->count; i++)
        run(&exec->launches[i]);
    return SUCCESS;
}

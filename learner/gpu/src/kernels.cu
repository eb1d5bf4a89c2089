// Kernels of a PPO update. They are compiled to kernels.ptx, which is part of the program, and as C by the tests, which play a
// driver. So each thread works alone: no shared memory, no barriers, no atomics, and the same result in every run.
//
// All numbers are in three arrays: `f` (parameters, batch, activations), `u` (order of rows, fields of launches) and `d`
// (what steps change). The fields of a launch begin at `u[at]`; offsets among them are offsets into `f` unless stated.

#ifndef KERNEL
#define KERNEL extern "C" __global__ void
#define INLINE static __device__ __forceinline__
#endif

typedef unsigned int u32;

// Entries of `d`, as in `Control`.
enum {
    START,
    KEPT_FIRST,
    KEPT_SECOND,
    LEARNING_RATE,
    MAX_GRAD_NORM,
    CLIP_RANGE,
    VALUE_COEFFICIENT,
    ENTROPY_COEFFICIENT,
    BOUNDS_COEFFICIENT,
    BOUNDS_LIMIT,
    SCALE,
    STEP_SIZE,
    ROOT_CORRECTION,
    FAILURE,
    POLICY,
    VALUE,
    BOUNDS,
    CLIPPED,
    ENTROPY,
    NORM
};

// Values of `d[FAILURE]`.
enum { BAD_LOSS = 1, BAD_GRADIENT, BAD_PARAMETER };

#define HALF_LN_TAU 0.9189385f
#define LOG_RATIO_MAX 20.0f
#define LOG_STD_MIN -5.0f
#define LOG_STD_MAX 2.0f

// Rows and columns of a thread's tile of a product; the 32 threads of a warp have neighbouring columns.
#define TILE_ROWS 8
#define TILE_COLUMNS 2
// Threads that sum a gradient's squares and the terms of a loss.
#define SUMMERS 1024
#define SUMS 5

INLINE u32 thread(void) { return blockIdx.x * blockDim.x + threadIdx.x; }

INLINE u32 smaller(u32 a, u32 b) { return a < b ? a : b; }

INLINE float clamped(float x, float low, float high) { return x < low ? low : x > high ? high : x; }

// Signs in `u`: 0, 1, and 2 for -1.
INLINE float sign(u32 code) { return code == 2 ? -1.0f : (float)code; }

// A mean of the policy: `joins` has two columns of the output, each with a sign; the first `biases` columns have a bias.
INLINE float mean(const float *output, const float *bias, u32 biases, const u32 *joins) {
    float even = output[joins[0]] + (joins[0] < biases ? bias[joins[0]] : 0.0f);
    return sign(joins[1]) * even + sign(joins[3]) * output[joins[2]];
}

// Copies rows: rows, width, first index in `u`, whether rows begin at START, source, target.
KERNEL gather(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at;
    u32 i = thread(), width = job[1];
    if (i >= job[0] * width)
        return;
    const u32 *index = u + job[2] + (job[3] ? (u32)d[START] : 0);
    f[(size_t)job[5] + i] = f[(size_t)job[4] + (size_t)index[i / width] * width + i % width];
}

// Transposes matrices: for each, source, target, rows, columns. Grid y: matrix.
KERNEL transpose(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at + 4 * blockIdx.y;
    u32 i = thread(), rows = job[2], columns = job[3];
    if (i < rows * columns)
        f[(size_t)job[1] + i % columns * rows + i / columns] = f[(size_t)job[0] + i];
}

// Adds products of a tile: `a` has the tile's rows at a stride and inner indices at another, one of which is 1, so that the
// compiler knows the distances; `b` has the tile's columns at distances of 32.
#define ADD_PRODUCTS(row_stride, inner_stride)                                        \
    _Pragma("unroll 4") for (u32 k = 0; k < count; k++) {                             \
        float right[TILE_COLUMNS];                                                    \
        _Pragma("unroll") for (int c = 0; c < TILE_COLUMNS; c++) right[c] = b[32 * c]; \
        _Pragma("unroll") for (int r = 0; r < TILE_ROWS; r++) {                       \
            float left = a[r * (size_t)(row_stride)];                                 \
            _Pragma("unroll") for (int c = 0; c < TILE_COLUMNS; c++) sums[r][c] += left * right[c]; \
        }                                                                             \
        a += (inner_stride);                                                          \
        b += b_step;                                                                  \
    }

// Matrix products: for each, slices, a, its strides by row and by inner index (one of them is 1), b, its stride by inner index,
// c, its stride by row, rows, columns, inner size, inner size of a slice, stride of c by slice. Grid z: slices of all of them.
// A tile at an edge reads past its matrix, inside `f`, and does not write what it finds there.
KERNEL product(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at;
    u32 slice = blockIdx.z;
    while (slice >= job[0]) {
        slice -= job[0];
        job += 13;
    }
    u32 rows = job[8], columns = job[9];
    u32 across = (columns + 32 * TILE_COLUMNS - 1) / (32 * TILE_COLUMNS), down = (rows + TILE_ROWS - 1) / TILE_ROWS;
    u32 warp = thread() / 32;
    if (warp >= across * down)
        return;
    u32 row = warp / across * TILE_ROWS, column = warp % across * (32 * TILE_COLUMNS) + threadIdx.x % 32;
    u32 begin = slice * job[11], count = smaller(begin + job[11], job[10]) - begin, b_step = job[5];
    const float *a = f + job[1] + (size_t)row * job[2] + (size_t)begin * job[3];
    const float *b = f + job[4] + (size_t)begin * b_step + column;
    float sums[TILE_ROWS][TILE_COLUMNS] = {{0.0f}};
    if (job[3] == 1) {
        ADD_PRODUCTS(job[2], 1)
    } else {
        ADD_PRODUCTS(1, job[3])
    }
    float *target = f + job[6] + (size_t)slice * job[12];
#pragma unroll
    for (int r = 0; r < TILE_ROWS; r++) {
#pragma unroll
        for (int c = 0; c < TILE_COLUMNS; c++) {
            if (row + r < rows && column + 32 * c < columns)
                target[(size_t)(row + r) * job[7] + column + 32 * c] = sums[r][c];
        }
    }
}

INLINE float elu(float x) { return x > 0.0f ? x : expm1f(x); }

INLINE float elu_slope(float h) { return h > 0.0f ? 1.0f : h + 1.0f; }

// Adds biases and applies ELU: for each network, rows, units that a thread does, width, half of it or 0, numbers, bias. With a
// half, the row holds u and v of a = u + v + bias and b = u - v + bias; a + b and a - b replace them. Grid y: network.
KERNEL activate(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at + 6 * blockIdx.y;
    u32 i = thread(), units = job[1];
    if (i >= job[0] * units)
        return;
    u32 unit = i % units, half = job[3];
    float *number = f + job[4] + (size_t)(i / units) * job[2] + unit, bias = f[job[5] + unit];
    if (half) {
        float a = elu(number[0] + bias + number[half]), b = elu(number[0] + bias - number[half]);
        number[0] = a + b;
        number[half] = a - b;
    } else {
        number[0] = elu(number[0] + bias);
    }
}

// Converts the gradient of what `activate` leaves to that of what it found: for each network, rows, units, width, half,
// gradient, activation. Grid y: network.
KERNEL activate_backward(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at + 6 * blockIdx.y;
    u32 i = thread(), units = job[1];
    if (i >= job[0] * units)
        return;
    size_t offset = (size_t)(i / units) * job[2] + i % units;
    u32 half = job[3];
    float *gradient = f + job[4] + offset;
    const float *activation = f + job[5] + offset;
    if (half) {
        float a = 0.5f * (activation[0] + activation[half]), b = 0.5f * (activation[0] - activation[half]);
        float by_a = (gradient[0] + gradient[half]) * elu_slope(a), by_b = (gradient[0] - gradient[half]) * elu_slope(b);
        gradient[0] = by_a + by_b;
        gradient[half] = by_a - by_b;
    } else {
        gradient[0] *= elu_slope(activation[0]);
    }
}

// Loss of each row, and its gradient by the outputs: rows, actions, order in `u`, actions, log-probabilities, advantages,
// returns, parameters, entries of log_std in `u`, output, bias, biases, joins in `u`, splits in `u`, means, gradient by
// means, by outputs, by log_std of each row, values, bias of values, gradient by values, terms.
KERNEL loss(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at;
    u32 r = thread(), rows = job[0], actions = job[1];
    if (r >= rows)
        return;
    u32 row = u[job[2] + (u32)d[START] + r];
    const float *taken = f + job[3] + (size_t)row * actions, *output = f + job[9] + (size_t)r * actions;
    const float *parameters = f + job[7], *bias = f + job[10];
    const u32 *log_std = u + job[8], *joins = u + job[12], *splits = u + job[13];
    float *means = f + job[14] + (size_t)r * actions, *by_means = f + job[15] + (size_t)r * actions;
    float *by_output = f + job[16] + (size_t)r * actions, *by_log_std = f + job[17] + (size_t)r * actions;
    float clip = (float)d[CLIP_RANGE], limit = (float)d[BOUNDS_LIMIT], share = 1.0f / (float)rows;
    float distance = 0.0f, constant = 0.0f, bounds = 0.0f;
    for (u32 a = 0; a < actions; a++) {
        float log = parameters[log_std[a]], at_mean = mean(output, bias, job[11], joins + 4 * a);
        float difference = taken[a] - at_mean, excess = at_mean - clamped(at_mean, -limit, limit);
        means[a] = at_mean;
        distance += difference * difference * expf(-2.0f * log);
        constant += log + HALF_LN_TAU;
        bounds += excess * excess;
    }
    float log_ratio = -0.5f * distance - constant - f[(size_t)job[4] + row];
    float ratio = expf(fminf(log_ratio, LOG_RATIO_MAX)), advantage = f[(size_t)job[5] + row];
    float gain = ratio * advantage, clipped = clamped(ratio, 1.0f - clip, 1.0f + clip) * advantage;
    // The derivative of the ratio is the ratio. Where the clipped gain is smaller, it is constant.
    float slope = gain <= clipped && log_ratio < LOG_RATIO_MAX ? -gain * share : 0.0f;
    float bounds_slope = (float)(2.0 * d[BOUNDS_COEFFICIENT]) * share;
    for (u32 a = 0; a < actions; a++) {
        float difference = taken[a] - means[a], pull = difference * expf(-2.0f * parameters[log_std[a]]);
        by_means[a] = slope * pull + bounds_slope * (means[a] - clamped(means[a], -limit, limit));
        by_log_std[a] = slope * (difference * pull - 1.0f);
    }
    for (u32 part = 0; part < actions; part++) {
        const u32 *split = splits + 4 * part;
        by_output[part] = sign(split[1]) * by_means[split[0]] + sign(split[3]) * by_means[split[2]];
    }
    float error = f[(size_t)job[18] + r] + f[job[19]] - f[(size_t)job[6] + row];
    f[(size_t)job[20] + r] = (float)d[VALUE_COEFFICIENT] * share * error;
    float *terms = f + job[21] + r;
    terms[0] = -fminf(gain, clipped);
    terms[rows] = 0.5f * error * error;
    terms[2 * rows] = bounds;
    terms[3 * rows] = fabsf(ratio - 1.0f) > clip ? 1.0f : 0.0f;
}

// Sums columns of rows: for each, rows, stride, columns, rows of a slice, source, target, stride of the target by slice.
// Grid y: slice, z: which.
KERNEL column_sums(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at + 7 * blockIdx.z;
    u32 column = thread(), begin = blockIdx.y * job[3], end = smaller(begin + job[3], job[0]);
    if (column >= job[2])
        return;
    const float *source = f + job[4] + column;
    float sum = 0.0f;
    for (u32 r = begin; r < end; r++)
        sum += source[(size_t)r * job[1]];
    f[(size_t)job[5] + (size_t)blockIdx.y * job[6] + column] = sum;
}

// Sums the slices of a gradient: slices, parameters, actions, partial gradients (each of the parameters, then of log_std by
// action), gradient, first log_std, number of them, entries of log_std in `u`.
KERNEL sum_slices(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at;
    u32 i = thread(), slices = job[0], actions = job[2];
    if (i >= job[1])
        return;
    size_t stride = job[1] + actions;
    const float *partial = f + job[3];
    float sum = 0.0f;
    if (i >= job[5] && i < job[5] + job[6]) {
        for (u32 a = 0; a < actions; a++) {
            if (u[job[7] + a] != i)
                continue;
            for (u32 s = 0; s < slices; s++)
                sum += partial[s * stride + job[1] + a];
            sum -= (float)d[ENTROPY_COEFFICIENT];
        }
    } else {
        for (u32 s = 0; s < slices; s++)
            sum += partial[s * stride + i];
    }
    f[(size_t)job[4] + i] = sum;
}

// Sums squares of a gradient, and terms of a loss: gradient, parameters, terms, rows, target in `d`.
KERNEL sum_terms(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at;
    u32 t = thread(), rows = job[3];
    if (t >= SUMMERS)
        return;
    double sums[SUMS] = {0.0, 0.0, 0.0, 0.0, 0.0};
    for (u32 i = t; i < job[1]; i += SUMMERS) {
        double g = f[(size_t)job[0] + i];
        sums[0] += g * g;
    }
    for (u32 r = t; r < rows; r += SUMMERS) {
        for (u32 k = 1; k < SUMS; k++)
            sums[k] += f[(size_t)job[2] + (size_t)(k - 1) * rows + r];
    }
    for (u32 k = 0; k < SUMS; k++)
        d[job[4] + k * SUMMERS + t] = sums[k];
}

// Adds up what `sum_terms` left to 32 sums each: source and target in `d`.
KERNEL sum_sums(float *f, u32 *u, double *d, u32 at) {
    u32 t = thread();
    if (t >= SUMS * 32)
        return;
    double sum = 0.0;
    for (u32 i = 0; i < SUMMERS / 32; i++)
        sum += d[u[at] + t / 32 * SUMMERS + t % 32 + i * 32];
    d[u[at + 1] + t] = sum;
}

// Ends a loss, and sets the factors of Adam: source in `d`, rows, actions, parameters, entries of log_std in `u`.
KERNEL prepare_step(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at;
    double sums[SUMS], entropy = 0.0, rows = job[1];
    if (thread() != 0)
        return;
    for (u32 k = 0; k < SUMS; k++) {
        sums[k] = 0.0;
        for (u32 i = 0; i < 32; i++)
            sums[k] += d[job[0] + k * 32 + i];
    }
    for (u32 a = 0; a < job[2]; a++)
        entropy += f[(size_t)job[3] + u[job[4] + a]] + HALF_LN_TAU + 0.5f;
    double norm = sqrt(sums[0]);
    if (d[FAILURE] == 0.0 && !isfinite(sums[1] + sums[2] + sums[3]))
        d[FAILURE] = BAD_LOSS;
    if (d[FAILURE] == 0.0 && !isfinite(norm))
        d[FAILURE] = BAD_GRADIENT;
    d[POLICY] += sums[1];
    d[VALUE] += sums[2];
    d[BOUNDS] += sums[3];
    d[CLIPPED] += sums[4];
    d[ENTROPY] += rows * entropy;
    d[NORM] += rows * norm;
    d[START] += rows;
    d[KEPT_FIRST] *= 0.9;
    d[KEPT_SECOND] *= 0.999;
    d[SCALE] = fmin(d[MAX_GRAD_NORM] / (norm + 1e-6), 1.0);
    d[STEP_SIZE] = d[LEARNING_RATE] / (1.0 - d[KEPT_FIRST]);
    d[ROOT_CORRECTION] = 1.0 / sqrt(1.0 - d[KEPT_SECOND]);
}

// Steps Adam: parameters, then their first and second moments; number of them, gradient, first log_std, number of them.
KERNEL adam(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at;
    u32 i = thread(), count = job[1];
    if (i >= count)
        return;
    float *parameter = f + job[0] + i, *first = parameter + count, *second = first + count;
    float gradient = f[(size_t)job[2] + i] * (float)d[SCALE];
    *first = 0.9f * *first + (float)(1.0 - 0.9) * gradient;
    *second = 0.999f * *second + (float)(1.0 - 0.999) * gradient * gradient;
    float next = *parameter - (float)d[STEP_SIZE] * *first / (sqrtf(*second) * (float)d[ROOT_CORRECTION] + 1e-8f);
    if (i >= job[3] && i < job[3] + job[4])
        next = clamped(next, LOG_STD_MIN, LOG_STD_MAX);
    if (!isfinite(next) && d[FAILURE] == 0.0)
        d[FAILURE] = BAD_PARAMETER;
    *parameter = next;
}

// Divergence of each row from the old policy: rows, actions, output, bias, biases, joins in `u`, old means, parameters, entries
// of log_std in `u`, old log_std, target in `d`.
KERNEL divergence(float *f, u32 *u, double *d, u32 at) {
    const u32 *job = u + at;
    u32 r = thread(), actions = job[1];
    if (r >= job[0])
        return;
    double sum = 0.0;
    for (u32 a = 0; a < actions; a++) {
        double now = mean(f + job[2] + (size_t)r * actions, f + job[3], job[4], u + job[5] + 4 * a);
        double apart = f[(size_t)job[6] + (size_t)r * actions + a] - now;
        double log = clamped(f[job[7] + u[job[8] + a]], LOG_STD_MIN, LOG_STD_MAX);
        double old = clamped(f[job[9] + a], LOG_STD_MIN, LOG_STD_MAX);
        sum += log - old + (exp(2.0 * old) + apart * apart) * 0.5 * exp(-2.0 * log) - 0.5;
    }
    d[job[10] + r] = sum;
}

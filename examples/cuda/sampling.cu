/* Rays on a CUDA device from aureole_sampling.h: how much of the sky a ball above a floor hides, in each of
 * 256 x 256 points of the floor, beside the closed form and beside the same rays on the host, bit by bit.
 * Without a device the host works alone.
 *
 *     nvcc -O2 -fmad=false -Xcompiler -ffp-contract=off -I include examples/cuda/sampling.cu -o sampling
 *     ./sampling
 */
#include <aureole_sampling.h>
#include <cstdio>
#include <cstring>
#include <vector>

constexpr uint32_t width = 256, rays = 64;
constexpr double height = 2.0; /* of the ball's centre, whose radius is 1 */

/* The ball's centre as seen from a point of the floor, which is 8 wide. */
__host__ __device__ static void to_centre(uint32_t x, uint32_t y, double to[3]) {
    to[0] = 8.0 * (x + 0.5) / width - 4.0;
    to[1] = 8.0 * (y + 0.5) / width - 4.0;
    to[2] = height;
}

/* The share of cosine-distributed rays that the ball stops. A pixel's samples are one Owen-scrambled Sobol
 * net. */
__host__ __device__ static float hidden(uint32_t x, uint32_t y) {
    double to[3];
    to_centre(x, y, to);
    const double square_distance = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    uint32_t stopped = 0;
    for (uint32_t sample = 0; sample < rays; ++sample) {
        aureole_sampler sampler = aureole_sampler_begin(1, x, y, sample);
        float u[2];
        aureole_draw_2d(&sampler, u);
        const double square[2] = {u[0], u[1]};
        double disk[2];
        aureole_point_to_disk(AUREOLE_MAP_CONCENTRIC, square, disk);
        const double up = sqrt(fmax(0.0, 1.0 - disk[0] * disk[0] - disk[1] * disk[1]));
        const double along = disk[0] * to[0] + disk[1] * to[1] + up * to[2];
        stopped += along > 0.0 && square_distance - along * along < 1.0;
    }
    return (float)stopped / rays;
}

__global__ void floor_of_device(float *image) {
    const uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < width * width)
        image[i] = hidden(i % width, i / width);
}

/* The image of the device, and the seconds that it takes; false where there is none. */
static bool on_device(std::vector<float> &image, float *seconds) {
    float *buffer;
    int devices = 0;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0 ||
        cudaMalloc(&buffer, image.size() * sizeof(float)) != cudaSuccess)
        return false;
    cudaEvent_t begin, end;
    cudaEventCreate(&begin);
    cudaEventCreate(&end);
    for (int warm = 0; warm < 2; ++warm) {
        cudaEventRecord(begin);
        floor_of_device<<<width * width / 128, 128>>>(buffer);
        cudaEventRecord(end);
    }
    const bool good =
        cudaMemcpy(image.data(), buffer, image.size() * sizeof(float), cudaMemcpyDeviceToHost) == cudaSuccess;
    cudaEventElapsedTime(seconds, begin, end);
    *seconds *= 1e-3f;
    cudaFree(buffer);
    return good;
}

int main() {
    std::vector<float> host(width * width), device(width * width);
    double squares = 0.0, random = 0.0;
    for (uint32_t i = 0; i < width * width; ++i) {
        host[i] = hidden(i % width, i / width);
        double to[3];
        to_centre(i % width, i / width, to);
        const double square_distance = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
        const double exact =
            height / (square_distance * sqrt(square_distance)); /* a ball wholly above the horizon */
        squares += (host[i] - exact) * (host[i] - exact);
        random += exact * (1.0 - exact) / rays;
    }
    printf("host   rms %.5f, by random rays %.5f\n", sqrt(squares / host.size()), sqrt(random / host.size()));
    float seconds = 0.0f;
    if (!on_device(device, &seconds)) {
        printf("device none\n");
        return 0;
    }
    size_t others = 0;
    for (size_t i = 0; i < host.size(); ++i)
        others += memcmp(&host[i], &device[i], sizeof host[i]) != 0;
    printf("device %zu points differ, %.3g rays per second\n", others, (double)rays * host.size() / seconds);
    return others != 0;
}

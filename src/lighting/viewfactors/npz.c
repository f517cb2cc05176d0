#include "lighting/viewfactors/view_factors.h"

#include <inttypes.h>
#include <string.h>
#include <zlib.h>

/* Every member has ZIP64 fields, so that all sizes are handled alike (PKWARE's APPNOTE 4.3 to 4.5). */

static void put_bytes(aur_npz *npz, size_t size, const void *bytes) {
    fwrite(bytes, 1, size, npz->stream);
    npz->position += size;
}

/* Little endian. */
static void put_number(aur_npz *npz, size_t bytes, uint64_t value) {
    unsigned char buffer[8];
    for (size_t i = 0; i < bytes; ++i)
        buffer[i] = (unsigned char)(value >> 8 * i);
    put_bytes(npz, bytes, buffer);
}

/* crc32 takes 32-bit lengths. */
static uint32_t checksum_of(uint32_t checksum, uint64_t size, const unsigned char *bytes) {
    while (size > 0) {
        const uint64_t part = size < UINT32_C(1) << 30 ? size : UINT32_C(1) << 30;
        checksum = (uint32_t)crc32(checksum, bytes, (uInt)part);
        bytes += part;
        size -= part;
    }
    return checksum;
}

/* The fields from the version to the sizes, identical in a member's header and in the directory. */
static void put_common(aur_npz *npz, const aur_npz_member *member, size_t extra) {
    put_number(npz, 2, 45); /* the version of ZIP64 */
    put_number(npz, 2, 0);
    put_number(npz, 2, 0);      /* stored */
    put_number(npz, 2, 0);      /* midnight */
    put_number(npz, 2, 0x0021); /* of 1 January 1980: files are reproducible */
    put_number(npz, 4, member->checksum);
    put_number(npz, 4, UINT32_MAX);
    put_number(npz, 4, UINT32_MAX);
    put_number(npz, 2, strlen(member->name));
    put_number(npz, 2, extra);
}

void aur_npz_add(aur_npz *npz, const char *name, const char *type, const char *shape, size_t count,
                 size_t width, const void *data) {
    if (npz->count == AUR_NPZ_MEMBERS)
        return;
    /* NumPy's header, padded so that the data begin at a multiple of 64. */
    char header[256];
    memcpy(header, "\x93NUMPY\x01\x00", 8);
    int length = snprintf(header + 10, sizeof header - 10,
                          "{'descr': '%s', 'fortran_order': False, 'shape': %s, }", type, shape);
    while ((10 + length + 1) % 64 != 0)
        header[10 + length++] = ' ';
    header[10 + length++] = '\n';
    header[8] = (char)(length & 0xff);
    header[9] = (char)(length >> 8);
    const uint64_t bytes = (uint64_t)count * width;
    aur_npz_member *const member = &npz->members[npz->count++];
    snprintf(member->name, sizeof member->name, "%s.npy", name);
    member->offset = npz->position;
    member->size = 10 + (uint64_t)length + bytes;
    member->checksum = checksum_of(0, 10 + (uint64_t)length, (const unsigned char *)header);
    member->checksum = checksum_of(member->checksum, bytes, data);
    put_number(npz, 4, 0x04034b50);
    put_common(npz, member, 20);
    put_bytes(npz, strlen(member->name), member->name);
    put_number(npz, 2, 1); /* the field of ZIP64 */
    put_number(npz, 2, 16);
    put_number(npz, 8, member->size);
    put_number(npz, 8, member->size);
    put_bytes(npz, 10 + (size_t)length, header);
    put_bytes(npz, bytes, data);
}

void aur_npz_end(aur_npz *npz) {
    const uint64_t start = npz->position;
    for (size_t i = 0; i < npz->count; ++i) {
        const aur_npz_member *const member = &npz->members[i];
        put_number(npz, 4, 0x02014b50);
        put_number(npz, 2, 45);
        put_common(npz, member, 28);
        put_number(npz, 2, 0); /* no comment */
        put_number(npz, 2, 0); /* on this disk */
        put_number(npz, 2, 0);
        put_number(npz, 4, 0);
        put_number(npz, 4, UINT32_MAX);
        put_bytes(npz, strlen(member->name), member->name);
        put_number(npz, 2, 1);
        put_number(npz, 2, 24);
        put_number(npz, 8, member->size);
        put_number(npz, 8, member->size);
        put_number(npz, 8, member->offset);
    }
    const uint64_t end = npz->position;
    put_number(npz, 4, 0x06064b50); /* ZIP64's end of the directory, */
    put_number(npz, 8, 44);
    put_number(npz, 2, 45);
    put_number(npz, 2, 45);
    put_number(npz, 4, 0);
    put_number(npz, 4, 0);
    put_number(npz, 8, npz->count);
    put_number(npz, 8, npz->count);
    put_number(npz, 8, end - start);
    put_number(npz, 8, start);
    put_number(npz, 4, 0x07064b50); /* where it is, */
    put_number(npz, 4, 0);
    put_number(npz, 8, end);
    put_number(npz, 4, 1);
    put_number(npz, 4, 0x06054b50); /* and the old end, which points to it */
    put_number(npz, 2, 0);
    put_number(npz, 2, 0);
    put_number(npz, 2, npz->count);
    put_number(npz, 2, npz->count);
    put_number(npz, 4, UINT32_MAX);
    put_number(npz, 4, UINT32_MAX);
    put_number(npz, 2, 0);
}

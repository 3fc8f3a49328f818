/* SPDX-License-Identifier: MIT
 * The packets between a serial arm and Tribo (docs/devices.md). Plain C, no library, no allocation: the firmware
 * of an arm can include this file unchanged.
 *
 * Tribo sends the byte '?'. The arm answers with a line of text: "tribo-arm 1;" and its data as key=value;
 * Then the arm sends a position at each of its ticks without a request, and Tribo a force at each of its ticks.
 */
#ifndef TRIBO_SERIAL_PACKETS_H
#define TRIBO_SERIAL_PACKETS_H

#include <stdint.h>

#define TRIBO_ARM_ASK '?'
#define TRIBO_ARM_HELLO "tribo-arm 1;"

/* A position: mark, sequence, x y z in steps (of `resolution_mm`; low byte first), buttons, check. */
#define TRIBO_PLACE_MARK 0xA5
#define TRIBO_PLACE_BYTES 11
/* A force: mark, x y z in mN (low byte first), check. */
#define TRIBO_FORCE_MARK 0x5A
#define TRIBO_FORCE_BYTES 9

struct tribo_place {
    uint8_t sequence, buttons;
    int16_t step[3];
};
struct tribo_force_mn {
    int16_t mn[3];
};

static inline void tribo_put16(uint8_t* at, int16_t value) {
    at[0] = (uint8_t)((uint16_t)value & 0xFF);
    at[1] = (uint8_t)((uint16_t)value >> 8);
}
static inline int16_t tribo_get16(const uint8_t* at) {
    return (int16_t)(uint16_t)(at[0] | ((uint16_t)at[1] << 8));
}

/* CRC-16/CCITT of all bytes of a packet except the last two. A sum of one byte would accept one damaged position in
 * 256, and the hand would get a blow. */
static inline int16_t tribo_check(const uint8_t* packet, int bytes) {
    uint16_t crc = 0xFFFF;
    for (int i = 0; i < bytes - 2; ++i) {
        crc = (uint16_t)(crc ^ ((uint16_t)packet[i] << 8));
        for (int bit = 0; bit < 8; ++bit)
            crc = (uint16_t)((crc & 0x8000) != 0 ? (uint16_t)(crc << 1) ^ 0x1021 : crc << 1);
    }
    return (int16_t)crc;
}

static inline void tribo_write_place(const struct tribo_place* place, uint8_t* packet) {
    packet[0] = TRIBO_PLACE_MARK;
    packet[1] = place->sequence;
    for (int i = 0; i < 3; ++i) tribo_put16(packet + 2 + 2 * i, place->step[i]);
    packet[8] = place->buttons;
    tribo_put16(packet + 9, tribo_check(packet, TRIBO_PLACE_BYTES));
}
/* Returns 1 if the bytes are a valid packet. */
static inline int tribo_read_place(const uint8_t* packet, struct tribo_place* place) {
    if (packet[0] != TRIBO_PLACE_MARK || tribo_get16(packet + 9) != tribo_check(packet, TRIBO_PLACE_BYTES))
        return 0;
    place->sequence = packet[1];
    for (int i = 0; i < 3; ++i) place->step[i] = tribo_get16(packet + 2 + 2 * i);
    place->buttons = packet[8];
    return 1;
}
static inline void tribo_write_force(const struct tribo_force_mn* force, uint8_t* packet) {
    packet[0] = TRIBO_FORCE_MARK;
    for (int i = 0; i < 3; ++i) tribo_put16(packet + 1 + 2 * i, force->mn[i]);
    tribo_put16(packet + 7, tribo_check(packet, TRIBO_FORCE_BYTES));
}
static inline int tribo_read_force(const uint8_t* packet, struct tribo_force_mn* force) {
    if (packet[0] != TRIBO_FORCE_MARK || tribo_get16(packet + 7) != tribo_check(packet, TRIBO_FORCE_BYTES))
        return 0;
    for (int i = 0; i < 3; ++i) force->mn[i] = tribo_get16(packet + 1 + 2 * i);
    return 1;
}

#endif

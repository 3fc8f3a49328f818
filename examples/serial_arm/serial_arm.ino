// SPDX-License-Identifier: MIT
// A HapKit (one handle, one motor) as an arm of Tribo: for a Hapkit board or any ATmega328 at 16 MHz. Copy
// devices/serial_packets.h next to this sketch. Stand the HapKit so that its handle goes up and down: it then
// is Tribo's z.
#include "serial_packets.h"

// The board's pins: motor driver and Hall sensor.
const int kPwmPin = 5, kDirectionPin = 8, kSensorPin = A2;
// Measure these three at your own: a full turn of the motor's magnet in counts of the sensor, the way of the
// handle for it, and the force at the handle for full power.
const int kCountsPerTurn = 720;
const float kMmPerTurn = 4.2f;
const float kFullForceN = 4.0f;
const float kStepMm = 0.01f;
const unsigned long kTickUs = 1000, kSilentUs = 5000;

long turns = 0;
int lastCount = 0, zeroCount = 0;
tribo_place place;
uint8_t incoming[TRIBO_FORCE_BYTES];
uint8_t held = 0;
unsigned long lastForceUs = 0, nextTickUs = 0;

void push(float newtons) {
    digitalWrite(kDirectionPin, newtons >= 0 ? HIGH : LOW);
    const float share = (newtons < 0 ? -newtons : newtons) / kFullForceN;
    analogWrite(kPwmPin, (int)(255 * (share < 1 ? share : 1)));
}

float handleMm() {
    const int count = analogRead(kSensorPin);
    if (count - lastCount > kCountsPerTurn / 2) --turns;
    if (lastCount - count > kCountsPerTurn / 2) ++turns;
    lastCount = count;
    return kMmPerTurn * (turns + (float)(count - zeroCount) / kCountsPerTurn);
}

// After a lost or damaged byte a packet may begin within the bytes that are held.
void dropToNextMark() {
    do {
        --held;
        memmove(incoming, incoming + 1, held);
    } while (held > 0 && incoming[0] != TRIBO_FORCE_MARK);
}

void setup() {
    Serial.begin(1000000);
    pinMode(kPwmPin, OUTPUT);
    pinMode(kDirectionPin, OUTPUT);
    push(0);
    zeroCount = lastCount = analogRead(kSensorPin);  // the handle stands in its middle as it is switched on
}

void loop() {
    while (Serial.available() > 0) {
        const uint8_t byte = (uint8_t)Serial.read();
        if (held == 0 && byte == TRIBO_ARM_ASK) {
            Serial.println(F(TRIBO_ARM_HELLO
                             "name=HapKit;max_n=4;max_n_per_mm=0.3;max_ns_per_mm=0.001;resolution_mm=0.01;"
                             "rate_hz=1000"));
            continue;
        }
        if (held == 0 && byte != TRIBO_FORCE_MARK) continue;
        incoming[held++] = byte;
        if (held < TRIBO_FORCE_BYTES) continue;
        tribo_force_mn force;
        if (!tribo_read_force(incoming, &force)) {
            dropToNextMark();
            continue;
        }
        held = 0;
        push(1e-3f * force.mn[2]);
        lastForceUs = micros();
    }
    const unsigned long now = micros();
    if (now - lastForceUs > kSilentUs) push(0);  // nobody is there: let go
    if ((long)(now - nextTickUs) < 0) return;
    nextTickUs = now + kTickUs;
    ++place.sequence;
    place.step[2] = (int16_t)(handleMm() / kStepMm);
    uint8_t packet[TRIBO_PLACE_BYTES];
    tribo_write_place(&place, packet);
    Serial.write(packet, TRIBO_PLACE_BYTES);
}

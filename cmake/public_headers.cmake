# The headers that `make install` installs, by the job that they serve: at most 40. Each group begins with what a user includes; the
# rest is what that includes. tests/package compiles each of them alone, and the programs in examples/source.

# A cut: a job in, rows with forces, contact samples, the part and its sound out; the force of an engagement by itself.
set(TRIBO_MILL_HEADERS
    tribo/mill.hpp
    tribo/sound.hpp
    milling/force/force.hpp
    milling/tool/materials.hpp
    base/file_result.hpp
    base/math.hpp
    base/mesh.hpp
    base/result.hpp
    base/vec3.hpp
    contact/contact_sample.hpp
    contact/distance_field.hpp
    contact/force_spectrum.hpp
    contact/force_trace.hpp
    milling/engagement/chip.hpp
    milling/engagement/collision.hpp
    milling/engagement/cut_row.hpp
    milling/engagement/engaged_edges.hpp
    milling/engagement/engagement.hpp
    milling/force/edge_force.hpp
    milling/force/force_peaks.hpp
    milling/force/lanes.hpp
    milling/force/row_force.hpp
    milling/force/turn_series.hpp
    milling/tool/coefficients.hpp
    milling/tool/cut_pose.hpp
    milling/tool/cutter.hpp
    milling/tool/cutter_profile.hpp
    milling/tool/tool_frame.hpp
    milling/tool/turned_profile.hpp
    session/cut/mill_totals.hpp)

# A material under a finger: the sheet that yields, its picture, its voice.
set(TRIBO_TOUCH_HEADERS
    tribo/touch.hpp
    elastic/contact_ellipse.hpp)

# A hand: a probe on a distance field, the servo, a force and an arm of one's own.
set(TRIBO_SENSE_HEADERS
    haptics/contact/field_contact.hpp
    haptics/servo/servo.hpp
    devices/force_plugin.h
    devices/serial_packets.h
    contact/half_spaces.hpp
    contact/search_memory.hpp
    haptics/contact/probe_gap.hpp
    haptics/contact/side_step.hpp
    haptics/device/device.hpp
    haptics/device/device_limits.hpp
    haptics/servo/loop_delay.hpp
    haptics/servo/passivity.hpp
    haptics/servo/safety.hpp)

set(TRIBO_PUBLIC_HEADERS ${TRIBO_MILL_HEADERS} ${TRIBO_TOUCH_HEADERS} ${TRIBO_SENSE_HEADERS})

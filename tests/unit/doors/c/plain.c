/* SPDX-License-Identifier: Apache-2.0 */
/* Every function of the C interface takes null pointers without a crash, and says what is wrong. */
#include <indurop/c.h>

#include <stdio.h>
#include <string.h>

static int failures = 0;

static void expect(const char* what, irp_code found, irp_code wanted) {
  if (found != wanted || (wanted != IRP_OK && irp_error()[0] == '\0')) {
    printf("%s: code %d, expected %d: %s\n", what, (int)found, (int)wanted, irp_error());
    ++failures;
  }
}

int main(void) {
  irp_node* node = (irp_node*)&failures;
  irp_variable variable = IRP_VARIABLE_INIT;
  irp_quality quality = IRP_QUALITY_INIT;
  irp_stream* stream = NULL;
  irp_recording* recording = (irp_recording*)&failures;
  int64_t time = 0;
  size_t taken = 0;
  uint64_t seen = 0;
  uint32_t id = 0;
  if (strlen(irp_version()) < 5 || irp_error()[0] != '\0' || irp_node_name(NULL)[0] != '\0') {
    printf("texts\n");
    ++failures;
  }
  if (irp_count(NULL) != 0 || irp_name(NULL, 0) != NULL) {
    printf("names\n");
    ++failures;
  }
  irp_close(NULL);
  expect("irp_open", irp_open("local", IRP_READ, NULL), IRP_INVALID);
  expect("irp_open", irp_open("not a name", IRP_READ, &node), IRP_INVALID);
  if (node != NULL) {
    printf("a node in spite of an error\n");
    ++failures;
  }
  expect("irp_open", irp_open("there-is-no-such-node", IRP_READ, &node), IRP_NOT_FOUND);
  expect("irp_running", irp_running(NULL), IRP_INVALID);
  expect("irp_refresh", irp_refresh(NULL), IRP_INVALID);
  expect("irp_find", irp_find(NULL, "a", &id), IRP_INVALID);
  expect("irp_describe", irp_describe(NULL, id, &variable), IRP_INVALID);
  expect("irp_read", irp_read(NULL, id, &id, sizeof id), IRP_INVALID);
  expect("irp_read_together", irp_read_together(NULL, NULL, 0, NULL, NULL), IRP_INVALID);
  expect("irp_get_quality", irp_get_quality(NULL, id, &quality), IRP_INVALID);
  expect("irp_get_text", irp_get_text(NULL, id, NULL, 0, NULL), IRP_INVALID);
  expect("irp_wait_change", irp_wait_change(NULL, id, &seen, 0), IRP_INVALID);
  irp_stream_close(NULL);
  expect("irp_stream_open", irp_stream_open(NULL, &id, 1, 0, &stream), IRP_INVALID);
  expect("irp_stream_read", irp_stream_read(NULL, &id, 1, NULL, 1, 0, NULL), IRP_INVALID);
  if (irp_stream_lost(NULL) != 0) {
    printf("lost runs of no stream\n");
    ++failures;
  }
  irp_recording_close(NULL);
  expect("irp_recording_open", irp_recording_open(NULL, &recording), IRP_INVALID);
  expect("irp_recording_open", irp_recording_open("/dev/null", NULL), IRP_INVALID);
  expect("irp_recording_open", irp_recording_open("/there/is/no/such.mcap", &recording), IRP_NOT_FOUND);
  if (recording != NULL) {
    printf("a recording in spite of an error\n");
    ++failures;
  }
  if (irp_recording_count(NULL) != 0 || irp_recording_name(NULL, 0) != NULL || irp_recording_damage(NULL, 0) != NULL) {
    printf("what is in no recording\n");
    ++failures;
  }
  expect("irp_recording_find", irp_recording_find(NULL, "a", &id), IRP_INVALID);
  expect("irp_recording_describe", irp_recording_describe(NULL, id, &variable), IRP_INVALID);
  expect("irp_recording_span", irp_recording_span(NULL, &time, &time), IRP_INVALID);
  expect("irp_recording_select", irp_recording_select(NULL, &id, 1, 0, 0, 0), IRP_INVALID);
  expect("irp_recording_read", irp_recording_read(NULL, &time, &id, &id, sizeof id, 1, &taken), IRP_INVALID);
  expect("irp_write", irp_write(NULL, id, &id, sizeof id, NULL), IRP_INVALID);
  expect("irp_set_text", irp_set_text(NULL, id, "1", NULL), IRP_INVALID);
  expect("irp_force", irp_force(NULL, id, &id, sizeof id, 0, NULL), IRP_INVALID);
  expect("irp_release", irp_release(NULL, id, NULL), IRP_INVALID);
  return failures == 0 ? 0 : 1;
}

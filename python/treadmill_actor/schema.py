"""Message classes of the bus.

`schema.binpb` holds proto/schema in compiled form and is read at import. Generated code would have to match the installed
version of protobuf. A test of the Rust crate `treadmill-proto` compares the file with the schemas and can rewrite it.
"""

from pathlib import Path

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory


def _messages():
    files = descriptor_pb2.FileDescriptorSet.FromString(Path(__file__).with_name("schema.binpb").read_bytes())
    # A separate pool cannot collide with other users of these schemas in this process.
    pool = descriptor_pool.DescriptorPool()
    for file in files.file:
        pool.Add(file)
    names = [f"{file.package}.{message.name}" for file in files.file for message in file.message_type]
    classes = {name.rsplit(".", 1)[1]: message_factory.GetMessageClass(pool.FindMessageTypeByName(name)) for name in names}
    outcomes = pool.FindEnumTypeByName("treadmill.v1.Outcome").values_by_name
    causes = pool.FindEnumTypeByName("treadmill.v1.EndCause").values_by_name
    return (
        classes,
        {name.removeprefix("OUTCOME_").lower(): value.number for name, value in outcomes.items()},
        {name.removeprefix("END_CAUSE_").lower(): value.number for name, value in causes.items()},
    )


MESSAGES, OUTCOMES, END_CAUSES = _messages()
OUTCOME_NAMES = {number: name for name, number in OUTCOMES.items()}

#: Version of the messages and of the configuration keys that this actor knows, as in the Rust crate `treadmill-proto`.
WIRE_VERSION = 2

ActorStats = MESSAGES["ActorStats"]
Fragment = MESSAGES["Fragment"]
PolicyAnnouncement = MESSAGES["PolicyAnnouncement"]
PolicyBundle = MESSAGES["PolicyBundle"]
PolicyPiece = MESSAGES["PolicyPiece"]
PolicyRequest = MESSAGES["PolicyRequest"]
PolicyVersion = MESSAGES["PolicyVersion"]
Receipt = MESSAGES["Receipt"]
TaskReceipt = MESSAGES["TaskReceipt"]
TaskRegistration = MESSAGES["TaskRegistration"]

open Dolphin_json

type t = Format : { name : string; title : string; codec : 'a Codec.t; refuses : bool } -> t

let all =
  [ Format
      { name = "journal"; title = "A line of a run journal, or of a partial trace: see docs/trace.md";
        codec = Dolphin_trace.Entry.codec; refuses = true };
    Format
      { name = "plan"; title = "A plan, as the platform protocol has it"; codec = Dolphin_platform_protocol.Plan_body.codec;
        refuses = true };
    Format
      { name = "platform-order"; title = "An order of the platform protocol: a line that Dolphin writes";
        codec = Dolphin_platform_protocol.Order.codec; refuses = false };
    Format
      { name = "platform-report"; title = "A report of the platform protocol: a line that an adapter writes";
        codec = Dolphin_platform_protocol.Report.codec; refuses = false };
    Format
      { name = "socket"; title = "A line on the socket of a run (docs/socket.md): a request, or a reply";
        codec = Dolphin_app.Socket_message.line; refuses = false } ]

let name (Format { name; _ }) = name

let find wanted =
  match List.find_opt (fun format -> name format = wanted) all with
  | Some format -> format
  | None -> invalid_arg ("no format is called " ^ wanted)

let schema (Format { title; codec; _ }) = Codec.schema ~title codec

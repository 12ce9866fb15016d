open Cmdliner
module Network = Dolphin_sim_imc.Network

(* {1 Values} *)

let positive = Options.positive ~docv:"NUMBER"
let natural = Options.number ~docv:"SECONDS" "a number, 0 or greater" (fun x -> x >= 0. && x < infinity)
let share = Options.number ~docv:"SHARE" "a number from 0 to 1" (fun x -> x >= 0. && x <= 1.)

let port = Options.between ~docv:"PORT" ~least:1 ~most:0xFFFF "a number"

(* [SECONDS], or [LEAST-MOST]. *)
let delay =
  let seconds text = match float_of_string_opt text with Some x when x >= 0. && x < 3600. -> Some x | _ -> None in
  let parse text =
    match List.map seconds (String.split_on_char '-' text) with
    | [ Some x ] -> Ok (x, x)
    | [ Some least; Some most ] when least <= most -> Ok (least, most)
    | _ -> Error (`Msg (Printf.sprintf "'%s' is not a delay such as 0.2 or 0.1-0.5" text))
  in
  Arg.conv ~docv:"SECONDS" (parse, fun ppf (least, most) -> Format.fprintf ppf "%g-%g" least most)

let ports =
  let parse text =
    match List.map int_of_string_opt (String.split_on_char '-' text) with
    | [ Some first; Some last ] when 0 < first && first <= last && last <= 0xFFFF -> Ok (first, last)
    | _ -> Error (`Msg (Printf.sprintf "'%s' is not a range of ports such as 30100-30104" text))
  in
  Arg.conv ~docv:"FIRST-LAST" (parse, fun ppf (first, last) -> Format.fprintf ppf "%d-%d" first last)

let host =
  let parse text =
    if Dolphin_sim_imc.Address.is_host text then Ok text
    else Error (`Msg (Printf.sprintf "'%s' is not an address such as 192.168.1.7" text))
  in
  Arg.conv ~docv:"ADDRESS" (parse, Format.pp_print_string)

(* [VEHICLE] or [VEHICLE=...]: names of vehicles may have any other character. *)
let named text =
  match String.index_opt text '=' with
  | None -> text, None
  | Some i -> String.sub text 0 i, Some (String.sub text (i + 1) (String.length text - i - 1))

let refusal =
  let parse text =
    let name, why = named text in
    Ok (name, Option.value why ~default:"refused")
  in
  Arg.conv ~docv:"VEHICLE[=WHY]" (parse, fun ppf (name, why) -> Format.fprintf ppf "%s=%s" name why)

let block =
  let span text =
    match List.map float_of_string_opt (String.split_on_char ',' text) with
    | [ Some from; Some lasts ] when from >= 0. && lasts > 0. -> Some (from, lasts)
    | _ -> None
  in
  let parse text =
    let name, rest = named text in
    match Option.bind rest span with
    | Some span -> Ok (name, span)
    | None -> Error (`Msg (Printf.sprintf "'%s' is not of the form VEHICLE=FROM,LASTING, both in seconds" text))
  in
  let print ppf (name, (from, lasts)) = Format.fprintf ppf "%s=%g,%g" name from lasts in
  Arg.conv ~docv:"VEHICLE=FROM,LASTING" (parse, print)

let vanishing =
  let seconds text = match float_of_string_opt text with Some x when x >= 0. -> Some x | Some _ | None -> None in
  let span text =
    match List.map seconds (String.split_on_char ',' text) with
    | [ Some from ] -> Some (from, infinity)
    | [ Some from; Some lasts ] when lasts > 0. -> Some (from, lasts)
    | _ -> None
  in
  let parse text =
    let name, rest = named text in
    match Option.bind rest span with
    | Some span -> Ok (name, span)
    | None -> Error (`Msg (Printf.sprintf "'%s' is not of the form VEHICLE=FROM or VEHICLE=FROM,LASTING" text))
  in
  let print ppf (name, (from, lasts)) = Format.fprintf ppf "%s=%g,%g" name from lasts in
  Arg.conv ~docv:"VEHICLE=FROM[,LASTING]" (parse, print)

(* {1 Options} *)

let faults_section = "FAULTS"
let network_section = "NETWORK"
let usual = Network.default Dolphin_scenario.Scenario.default
let option ?(section = Manpage.s_options) name kind default ~docv doc =
  Arg.(value & opt kind default & info [ name ] ~docs:section ~docv ~doc)

let speed =
  option "speed" positive usual.speed ~docv:"X" "Let missions run $(docv) times as fast as in reality."

let seed = option "seed" Arg.int usual.seed ~docv:"N" "Seed of the random numbers for plans and links."

let strict =
  let doc =
    "Refuse plans that the fleet file does not have. By default a vehicle runs them for 1 to 3 minutes."
  in
  Arg.(value & flag & info [ "strict" ] ~doc)

let flood =
  option "flood" natural usual.flood ~docv:"RATE"
    "Let each vehicle send $(docv) further datagrams a second, as sensors produce them; a real vehicle sends 700."

(* {2 Faults} *)

let fault name kind default ~docv doc = option ~section:faults_section name kind default ~docv doc

let faults =
  let loss = fault "loss" share 0. ~docv:"SHARE" "Lose this share of the datagrams, from 0 to 1, in both directions." in
  let duplication = fault "duplication" share 0. ~docv:"SHARE" "Deliver this share of the datagrams twice." in
  let reordering =
    fault "reordering" share 0. ~docv:"SHARE"
      "Hold this share of the datagrams back for 10 to 100 ms, so that others overtake them."
  in
  let delay =
    fault "delay" delay (0., 0.) ~docv:"SECONDS"
      "Delay each datagram by $(docv), or by a random time between $(i,LEAST-MOST)."
  in
  let open Options.Syntax in
  let+ loss = loss
  and+ duplication = duplication
  and+ reordering = reordering
  and+ delay = delay in
  { Dolphin_sim_imc.Link_faults.loss; duplication; reordering; delay }

let refuses =
  let doc = "Let the vehicle refuse to start any plan, with the words $(i,WHY). May be repeated." in
  Arg.(value & opt_all refusal [] & info [ "refuse" ] ~docs:faults_section ~docv:"VEHICLE[=WHY]" ~doc)

let blocks =
  let doc =
    "Let the vehicle be under external control and its plans BLOCKED, $(i,LASTING) seconds long from $(i,FROM) seconds \
     after the start, by the mission's clock. May be repeated."
  in
  Arg.(value & opt_all block [] & info [ "block" ] ~docs:faults_section ~docv:"VEHICLE=FROM,LASTING" ~doc)

let stalls =
  let doc =
    "Let the vehicle's computer stall $(i,FROM) seconds after the start, by the mission's clock, for $(i,LASTING) \
     seconds. The vehicle sends nothing meanwhile. Then its plan engine has lost the running plan: it is BLOCKED and \
     answers STOP by $(b,no plan is running), while the vehicle reports MANEUVER and continues to the end of its \
     maneuver, or until an Abort. May be repeated."
  in
  Arg.(value & opt_all block [] & info [ "stall" ] ~docs:faults_section ~docv:"VEHICLE=FROM,LASTING" ~doc)

let vanishes =
  let doc =
    "Let the vehicle vanish from the network $(i,FROM) seconds after the start, by the mission's clock, and return \
     $(i,LASTING) seconds later, or never. Its plan continues meanwhile. May be repeated."
  in
  Arg.(value & opt_all vanishing [] & info [ "vanish" ] ~docs:faults_section ~docv:"VEHICLE=FROM[,LASTING]" ~doc)

(* {2 Network} *)

let network name kind default ~docv doc = option ~section:network_section name kind default ~docv doc

let announce_period =
  network "announce" positive usual.announce_period ~docv:"SECONDS" "Announce vehicles every $(docv) seconds."

let contact_period =
  network "contact" natural usual.contact_period ~docv:"SECONDS"
    "Let vehicles check every $(docv) seconds for new systems to send to; 0: at once."

let first_port = network "port" port usual.first_port ~docv:"PORT" "Look for free data ports from $(docv) on."

let first_id =
  network "first-id" port usual.first_id ~docv:"N" "The number of the first vehicle as an IMC system; others follow."

let discovery_ports =
  network "discovery-ports" ports usual.discovery_ports ~docv:"FIRST-LAST"
    "The ports on which IMC systems find each other."

let address =
  let doc =
    "The address of this host by which other hosts find the vehicles, as 192.168.1.7. By default only programs on this \
     host do."
  in
  Arg.(value & opt (some host) None & info [ "address" ] ~docs:network_section ~docv:"ADDRESS" ~doc)

let settings =
  let open Options.Syntax in
  let+ speed = speed
  and+ seed = seed
  and+ strict = strict
  and+ flood = flood
  and+ faults = faults
  and+ refuses = refuses
  and+ blocks = blocks
  and+ stalls = stalls
  and+ vanishes = vanishes
  and+ announce_period = announce_period
  and+ contact_period = contact_period
  and+ first_port = first_port
  and+ first_id = first_id
  and+ discovery_ports = discovery_ports
  and+ address = address in
  fun scenario : Network.settings ->
    { scenario; seed; speed; strict; flood; faults; refuses; blocks; stalls; vanishes; announce_period;
      contact_period; first_port; first_id; discovery_ports; address }

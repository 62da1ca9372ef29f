# fish completion of input-monitor. Made by scripts/completions out of --help; changes belong there.


function __yars_sessions
    string replace -f -r '^/dev/shm/yars\.'(id -u)'\.' '' /dev/shm/yars.*
end

# Words; what follows route: and the like is a file.
function __yars_source
    set -l word (commandline -ct)
    if string match -q '*:*' -- $word
        string replace -r '^' (string split -m 1 : -- $word)[1]: (__fish_complete_path (string split -m 1 : -- $word)[2])
    else
        printf '%s\n' $argv
    end
end

complete -c input-monitor -f
complete -c input-monitor -s h -l help -d 'print this help'
complete -c input-monitor -l version -d 'print the version'
complete -c input-monitor -l session -x -a '(__yars_sessions)' -d 'session to join or create'
complete -c input-monitor -l config -r -F -d 'GUF configuration file'
complete -c input-monitor -l log-level -x -a 'trace debug info warning error off' -d 'lines of this level and above are logged'
complete -c input-monitor -l lockstep -x -d 'roles that step together on sim time, ROLE,ROLE,...[@END_TICK]; give all these roles the same value'
complete -c input-monitor -l log-dir -x -a '(__fish_complete_directories)' -d 'folder for a rotated log file'
complete -c input-monitor -l realtime -d 'lock memory, run the tick loop under SCHED_FIFO; a refusal is logged'
complete -c input-monitor -l cpus -x -d 'CPUs to run on, as in 2,3 or 2-3'
complete -c input-monitor -l source -x -a '(__yars_source auto evdev: script: terminal tour: window)' -d 'window, terminal, script:FILE, tour:FILE[,pilot], evdev:PATH[,MAP] or auto; repeatable'
complete -c input-monitor -l learn -r -F -d 'path of a device: asks for one control after the other and makes a device map; needs no session'
complete -c input-monitor -l out -r -F -d 'file for the map of --learn'
